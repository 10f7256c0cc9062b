#pragma once

#include <vector>

namespace dem
{
/// One body's share in the elasticity of a contact; `is_rigid` contributes 0.
struct Elasticity
{
  double shear_modulus = 0.; ///< G [Pa]
  double poisson_ratio = 0.; ///< nu [-]
  bool is_rigid = false;
};

/// Sums over the two bodies of a contact, mixed once at setup.
struct PairElasticity
{
  double modulus = 0.;          ///< E*: 1/E* = sum (1 - nu_i) / (2 G_i) [Pa]
  double compliance = 0.;       ///< sum 1 / G_i [1/Pa]
  double cross_compliance = 0.; ///< sum nu_i / G_i [1/Pa]
};

/// Throws std::invalid_argument if both are rigid or a modulus is not positive.
PairElasticity mix(const Elasticity &a, const Elasticity &b);

/// Both bodies' principal curvatures at the contact, kappa_1 >= kappa_2,
/// regularised [1/m], and the angle between their kappa_1 directions.
struct PairCurvatures
{
  double first_a = 0., second_a = 0.; ///< [1/m]
  double first_b = 0., second_b = 0.; ///< [1/m]
  double cos_2psi = 1.;               ///< cosine of twice the angle [-]
};

/// Gap z = A x^2 + B y^2, 0 < A <= B (Johnson 1985, 4.1).
struct GapCoefficients
{
  double a = 0.; ///< A [1/m]
  double b = 0.; ///< B [1/m]
};

/// A + B from the sum of the curvatures, A B without cancellation; a line
/// contact (A -> 0) is kept at A = 1e-12 B.
GapCoefficients gap_coefficients(const PairCurvatures &curvatures);

/// Prefactors of one elliptic contact: F = normal delta^(3/2),
/// k_n = 3/2 normal delta^(1/2), k_s = tangential delta^(1/2).
struct HertzPrefactors
{
  double normal = 0.;     ///< C_H [N/m^(3/2)]
  double tangential = 0.; ///< k_s / sqrt(delta) [N/m^(3/2)]
};

/// The exact solution by bisection and the arithmetic-geometric mean
/// (docs/theory/elliptic.md), with all that the reference tables list.
struct EllipticContact
{
  double eccentricity = 0.; ///< e [-]
  double K = 0., E = 0.;    ///< complete elliptic integrals of e [-]
  double axis_ratio = 1.;   ///< alpha = a / b >= 1 [-]
  double ks_major = 0.;     ///< / sqrt(delta), load along a [N/m^(3/2)]
  double ks_minor = 0.;     ///< / sqrt(delta), load along b [N/m^(3/2)]
  double major_axis = 0.;   ///< a / sqrt(delta) [m^(1/2)]
  double minor_axis = 0.;   ///< b / sqrt(delta) [m^(1/2)]
  HertzPrefactors prefactors;
};

EllipticContact solve_elliptic(const PairElasticity &pair,
                               const GapCoefficients &gap);

/// The same prefactors from Chebyshev fits in ln(B/A) made once from the exact
/// solver: relative error below 1e-9 for 1 <= B/A <= 1e4; a longer ellipse is
/// taken as one with A = B / 1e4. No elliptic integral and no root at run time.
/// With R_g = 1 / (2 sqrt(A B)), f = f_F and q = B_c / K:
///   C_H = 4/3 E* sqrt(R_g) f,
///   k_s / sqrt(delta) = 2 sqrt(R_g) f [1 / (s - q t) + 1 / (s - (1 - q) t)],
/// s = sum 1 / G_i, t = sum nu_i / G_i, since 2 pi a / K = 4 f sqrt(R_g delta).
class EllipticTable
{
public:
  EllipticTable();
  HertzPrefactors operator()(const PairElasticity &pair,
                             const GapCoefficients &gap) const;

private:
  /// Coefficients of f_F and of B_c / K, of the same number [-].
  std::vector<double> force, directional;
};

/// The table (made once, shared).
const EllipticTable &elliptic_table();
} // namespace dem
