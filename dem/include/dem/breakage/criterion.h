#pragma once

#include <dem/vector.h>

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

/// One step of Eqs. 4 and 5 for one contact side.
struct DamageStep
{
  double factor = 0.; ///< cumulative factor after the step [-]
  BreakageMode mode = BreakageMode::none; ///< II takes precedence over I
};

/// `energy_before`, `energy` are the elastic energies at the old and the new
/// step [J], `fracture_energy` is G_c A_i of the new step [J].
DamageStep damage_step(double factor, double energy_before, double energy,
                       double fracture_energy);

/// Eq. 6: mode I takes one off, mode II sets to zero.
double factor_after(BreakageMode mode, double factor);
} // namespace dem
