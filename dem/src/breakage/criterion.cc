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

DamageStep damage_step(double factor, double energy_before, double energy,
                       double fracture_energy)
{
  DEM_ASSERT(fracture_energy > 0.);
  DamageStep step;
  step.factor =
      factor + std::max(0., (energy - energy_before) / fracture_energy);
  if (energy > fracture_energy)
    step.mode = BreakageMode::instantaneous;
  else if (step.factor > 1.)
    step.mode = BreakageMode::cumulative;
  return step;
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
