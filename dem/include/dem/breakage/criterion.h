#pragma once

#include <dem/contact/damage.h>
#include <dem/parameters/breakage.h>

namespace dem
{
enum class BreakageMode
{
  none,
  cumulative,   ///< mode I: the cumulative factor exceeds one
  instantaneous ///< mode II: the elastic energy exceeds G_c A_i
};

/// The overlap region of one contact on the side of one particle.
struct Cap
{
  double area = 0.;   ///< A_i = 2 pi delta / sqrt(K_G) [m^2], Eq. 15
  double volume = 0.; ///< V_i = A_i delta / 2 [m^3], Eq. 16
};

/// `gaussian_curvature` is the particle's own kappa_max kappa_min, both floored
/// [1/m^2]; `overlap` > 0 [m].
Cap cap_of(double overlap, double gaussian_curvature);

/// Where both conditions hold, the one that takes precedence.
BreakageMode mode_of(const DamageStep<double> &step,
                     ModePrecedence precedence = ModePrecedence::instantaneous);

/// Eq. 6: mode I takes one off, mode II sets to zero.
double factor_after(BreakageMode mode, double factor);
} // namespace dem
