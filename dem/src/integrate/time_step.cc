#include <dem/integrate/time_step.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace dem
{
namespace
{
/// Step of one oscillator with a dashpot that lags by half a step.
double lagged_step(double stiffness, double mass, double damping_ratio)
{
  return 2. * std::sqrt(mass / stiffness) *
         (std::sqrt(1. + damping_ratio * damping_ratio) - damping_ratio);
}

/// The spring along the wall also turns the ball, 1/m + r^2/I = 3.5/m: its
/// dashpot 2 beta sqrt(m k_s) is sqrt(3.5) times as strong for that mode.
double wall_step(const WallMaterial &wall, double mass)
{
  constexpr double turning = 3.5;
  const double normal =
      lagged_step(wall.normal_stiffness, mass, wall.normal_damping);
  if (wall.shear_stiffness <= 0.)
    return normal;
  return std::min(normal, lagged_step(wall.shear_stiffness, mass / turning,
                                      wall.shear_damping * std::sqrt(turning)));
}
} // namespace

StepLimit critical_step(const EngineParameters &parameters,
                        const Particles &particles)
{
  const double mass =
      *std::min_element(particles.mass.begin(), particles.mass.end());
  const double radius =
      *std::min_element(particles.radius.begin(), particles.radius.end());
  const StoneMaterial &stone = parameters.stone;
  StepLimit limit{std::numbers::pi * radius *
                      std::sqrt(stone.density / stone.shear_modulus) /
                      (0.1631 * stone.poisson_ratio + 0.8766),
                  "Rayleigh wave in the smallest stone"};
  if (const double step = wall_step(parameters.wall, mass); step < limit.step)
    limit = {step, "lightest stone on a wall (Wall/normal_stiffness)"};
  if (const double step = wall_step(parameters.surface, mass);
      step < limit.step)
    limit = {step, "lightest stone on the membrane "
                   "(MembraneContact/normal_stiffness)"};
  return limit;
}
} // namespace dem
