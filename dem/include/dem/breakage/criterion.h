#pragma once

#include <dem/triple.h>

#include <algorithm>

namespace dem
{
/// Parameters of the energy criterion (article, Table 2).
struct BreakageParameters
{
  bool is_active = true;             ///< stones may break at all
  double fracture_energy = 1e4;      ///< G_c, breakage energy per area [J/m^2]
  double min_ball_radius = 2e-3;     ///< no further breakage below this [m]
  double min_diameter = 7.1e-3;      ///< breakable from this initial size [m]
  double curvature_floor_ratio = 10; ///< beta in kappa_f = 1/(beta r_ins) [-]
  double kernel_floor = 2.5;         ///< c_lambda in lambda >= c / N_s [-]
  /// Rings of the rule that measures a stone anew after an event (volume,
  /// inscribed radius, depth of the chip): 2 n^2 nodes.
  int quadrature_rings = 40;
};

enum class BreakageMode
{
  none,
  cumulative,   ///< mode I: the cumulative factor exceeds one
  instantaneous ///< mode II: the elastic energy exceeds G_c A_i
};

/// The overlap region of one contact as one of its stones sees it.
struct Cap
{
  double area = 0.;   ///< A_i = 2 pi delta / sqrt(K_G) [m^2], Eq. 15
  double volume = 0.; ///< V_i = A_i delta / 2 [m^3], Eq. 16
};

/// `gaussian_curvature` is the stone's own kappa_max kappa_min, both floored
/// [1/m^2]; `overlap` > 0 [m].
Cap cap_of(double overlap, double gaussian_curvature);

/// A_i / delta = 2 pi / sqrt(K_G) of a corner [m], Eq. 15.
double cap_slope(double gaussian_curvature);

/// One step of Eqs. 4 and 5 for one contact side.
template <class Real>
struct DamageStep
{
  Real factor = Real(0.); ///< cumulative factor after the step [-]
  /// Above one: mode I by the factor, mode II by E_e / (G_c A_i) [-].
  Real energy_ratio = Real(0.);
};

/// `energy_before`, `energy` are the elastic energies at the old and the new
/// step [J], `fracture_energy` > 0 is G_c A_i of the new step [J].
template <class Real>
DEM_LANE_INLINE DamageStep<Real>
damage_step(const Real &factor, const Real &energy_before, const Real &energy,
            const Real &fracture_energy)
{
  using std::max;
  const Real share = 1. / fracture_energy;
  return {factor + max(Real(0.), Real((energy - energy_before) * share)),
          energy * share};
}

/// II takes precedence over I.
BreakageMode mode_of(const DamageStep<double> &step);

/// Eq. 6: mode I takes one off, mode II sets to zero.
double factor_after(BreakageMode mode, double factor);
} // namespace dem
