#include <dem/contact/law_table.h>
#include <dem/contact/laws.h>
#include <dem/integrate/time_step.h>

#include <algorithm>
#include <cmath>
#include <limits>
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

/// Step of a sphere on the wall that slides and turns. With t = dt sqrt(k_s /
/// m), p = t^2 + 4 beta_s t for the spring with its lagged dashpot on x - r
/// theta and q = t^2 for the rolling spring k_s r^2 on theta (0 without), the
/// motion that changes its sign at every step is the limit: 16 - 14 p - 10 q +
/// 5/2 p q = 0. Without the rolling spring this is lagged_step() with 1/m +
/// r^2/I = 3.5/m.
double shear_step(const ContactCoefficients &coefficients, double stiffness,
                  double mass)
{
  const double rolling = coefficients.rolling_friction > 0. ? 1. : 0.;
  const auto is_stable = [&](double t)
  {
    const double p = t * (t + 4. * coefficients.shear_damping),
                 q = rolling * t * t;
    return 16. - 14. * p - 10. * q + 2.5 * p * q > 0.;
  };
  // Unstable at 2 / sqrt(3.5) at the latest; stable all the way below.
  double stable = 0., unstable = 1.07;
  for (int pass = 0; pass < 60; ++pass)
  {
    const double middle = 0.5 * (stable + unstable);
    (is_stable(middle) ? stable : unstable) = middle;
  }
  return stable * std::sqrt(mass / stiffness);
}

/// Step of a mass on a wall of this law, where its stiffness is constant.
double spring_step(const LawChoice &law,
                   const ContactCoefficients &coefficients, double mass)
{
  if (law.entry().exponent > 1.) // as stiff as it is pressed
    return std::numeric_limits<double>::infinity();
  const NormalSpring<double> spring = law.constant_spring();
  const double normal =
      lagged_step(spring.stiffness, mass, coefficients.normal_damping);
  return spring.shear_stiffness > 0.
             ? std::min(normal,
                        shear_step(coefficients, spring.shear_stiffness, mass))
             : normal;
}

double wall_step(const WallMaterial &wall, double mass)
{
  return spring_step(law_of(wall), coefficients_of(wall), mass);
}

/// Step of two of the lightest particles on each other where their law has a
/// constant stiffness: as one of half the mass on a wall, whose rolling spring
/// is four times as stiff.
double pair_step(const ParticleMaterial &particle, double mass)
{
  return spring_step(law_of(particle), coefficients_of(particle), 0.5 * mass);
}

/// Material 0 as a solid among the others.
SolidMaterial solid_of(const EngineParameters &parameters, std::size_t material)
{
  const ParticleMaterial &particle = parameters.particle;
  return material > 0 ? parameters.other_solids.at(material - 1)
                      : SolidMaterial{particle.density, particle.shear_modulus,
                                      particle.poisson_ratio};
}

/// The shortest over the materials, each by its smallest body.
StepLimit rayleigh_step(const EngineParameters &parameters,
                        const ParticleSystem &particles)
{
  StepLimit limit{std::numeric_limits<double>::infinity(), "no particle"};
  for (std::size_t m = 0; m <= parameters.other_solids.size(); ++m)
  {
    double radius = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < particles.size(); ++i)
      if (particles.material[i] == m)
        radius = std::min(radius, particles.radius(i) *
                                      std::sqrt(particles.mass_factor[i]));
    const SolidMaterial solid = solid_of(parameters, m);
    const double step = std::numbers::pi * radius *
                        std::sqrt(solid.density / solid.shear_modulus) /
                        (0.1631 * solid.poisson_ratio + 0.8766);
    if (step < limit.step)
      limit = {step, m > 0 ? "Rayleigh wave in the smallest sphere that is no "
                             "particle"
                           : "Rayleigh wave in the smallest particle"};
  }
  return limit;
}
} // namespace

StepLimit critical_step(const EngineParameters &parameters,
                        const ParticleSystem &particles,
                        const std::string &surface)
{
  const double mass = particles.smallest_mass();
  StepLimit limit = rayleigh_step(parameters, particles);
  if (const double step = pair_step(parameters.particle, mass);
      step < limit.step)
    limit = {step, "lightest particles on each other (Contact/law)"};
  if (const double step = wall_step(parameters.wall, mass); step < limit.step)
    limit = {step, parameters.wall.law == Linear::name
                       ? "lightest particle on a wall (Wall/normal_stiffness)"
                       : "lightest particle on a wall (Wall/law)"};
  if (const double step = wall_step(parameters.surface, mass);
      step < limit.step)
    limit = {step, "lightest particle on " + surface};
  return limit;
}
} // namespace dem
