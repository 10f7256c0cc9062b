#include <dem/assert.h>
#include <dem/breakage/criterion.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace dem
{
Cap cap_of(double overlap, double gaussian_curvature)
{
  DEM_ASSERT(gaussian_curvature > 0.); // curvatures come floored
  Cap cap;
  cap.area = 2. * std::numbers::pi * overlap / std::sqrt(gaussian_curvature);
  cap.volume = 0.5 * cap.area * overlap;
  return cap;
}

BreakageMode mode_of(const DamageStep<double> &step, ModePrecedence precedence)
{
  const bool is_one = step.factor > 1., is_two = step.energy_ratio > 1.;
  if (is_two && !(is_one && precedence == ModePrecedence::cumulative))
    return BreakageMode::instantaneous;
  return is_one ? BreakageMode::cumulative : BreakageMode::none;
}

double factor_after(BreakageMode mode, double factor)
{
  switch (mode)
  {
  case BreakageMode::cumulative:
    return factor - 1.;
  case BreakageMode::instantaneous:
    return 0.;
  case BreakageMode::none:
    break;
  }
  return factor;
}
} // namespace dem
