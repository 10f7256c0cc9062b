#pragma once

namespace fem
{
/// Per unit of reference area, with a tension T that is there at the start
/// and stays: S = S_law + T I, W = W_law + T tr(E).
/// St Venant-Kirchhoff in plane stress:
/// S_law = c ((1 - nu) E + nu tr(E) I) with c = E h / (1 - nu^2).
/// Incompressible neo-Hooke, C = 1 + 2 E: W_law = mu h / 2 (tr C + 1 / det C
/// - 3), S_law = mu h (I - adj(C) / det(C)^2).
/// With has_wrinkles the sheet shortens at will across its wrinkles: see
/// TensionLine.
struct SheetMaterial
{
  double stiffness = 0.;     ///< c [N/m], of St Venant-Kirchhoff
  double poisson_ratio = 0.; ///< nu [-], of St Venant-Kirchhoff
  double shear = 0.;         ///< mu h [N/m]; above 0 for neo-Hooke
  double tension = 0.;       ///< T [N/m]
  bool has_wrinkles = false; ///< tension field: no compression
  double residual = 0.;      ///< r [-], share of the law that stays
};

/// Relaxed energy (Pipkin 1986, Steigmann 1990): W_r(E) = min W(E + H) over
/// H >= 0, the shortening that is hidden in wrinkles; S_r = dW_r/dE. For an
/// isotropic law that is the mixed criterion (Roddeman et al. 1987) with the
/// principal axes of E:
///   taut      least principal stress of the law > 0:  S_r = S;
///   slack     major principal value C1 of C <= slack: S_r = 0;
///   wrinkled  else:  S_r = s(C1) n1 (x) n1, with S_22 = 0 made by H.
/// s = Y (C1 - 1) / 2 + T (1 - nu), Y = E h, for St Venant-Kirchhoff;
/// s = mu h (k - k^(1/2) C1^(-3/2)), k = 1 + T / (mu h), for neo-Hooke.
/// What acts is (1 - r) S_r + r S, and so the energy.
struct TensionLine
{
  bool is_neo_hookean = false;
  double modulus = 0.; ///< Y or mu h [N/m]
  double start = 0.;   ///< T (1 - nu) [N/m], or k [-]
  double energy = 0.;  ///< of St Venant-Kirchhoff at C1 = 1, or -T [N/m]
  double slack = 1.;   ///< C1 at which s = 0 [-]
};
TensionLine tension_line(const SheetMaterial &material);

/// Components 11, 22 and 12 of a symmetric surface tensor.
struct Symmetric
{
  double xx, yy, xy;
};

Symmetric right_cauchy_green(const Symmetric &e);
double contract(const Symmetric &a, const Symmetric &b);

/// S h [N/m] at the Green-Lagrange strain e.
Symmetric stress(const SheetMaterial &m, const Symmetric &e);

/// Change of the stress with a change `de` of the strain.
Symmetric stress_change(const SheetMaterial &m, const Symmetric &e,
                        const Symmetric &de);

/// W [J/m^2]
double energy_density(const SheetMaterial &m, const Symmetric &e);

/// The law would be in compression along one axis.
bool is_wrinkled(const SheetMaterial &m, const Symmetric &e);
} // namespace fem
