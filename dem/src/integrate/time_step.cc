#include <dem/integrate/time_step.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace dem
{
namespace
{
double wall_step(const WallMaterial &wall, double mass)
{
  const double beta = wall.normal_damping;
  return 2. * std::sqrt(mass / wall.normal_stiffness) *
         (std::sqrt(1. + beta * beta) - beta);
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
