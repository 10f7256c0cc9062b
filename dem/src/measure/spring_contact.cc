#include "spring_contact.h"

#include <dem/measure/totals.h>
#include <dem/parallel/distribution.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace dem
{
namespace
{
/// Impacts below this share of the energy of all particles do not count [-].
constexpr double negligible_impact = 1e-6;

/// Adds the contact to the impacts if what moves in it is more than what its
/// spring holds: contacts under a load that stays are no impacts.
void note_impact(const SpringContact &c, const Foresight &ahead,
                 ForeseenImpact &impact)
{
  const double kinetic =
      0.5 * c.reduced_mass * c.closing_speed * c.closing_speed;
  if (ahead.horizon <= 0. || c.hertz_prefactor <= 0. || kinetic < c.stored ||
      kinetic + c.stored < ahead.least_energy)
    return;
  const double speed = std::sqrt(2. * (kinetic + c.stored) / c.reduced_mass) +
                       ahead.gained_speed;
  impact.meet(
      {impact_duration(c.hertz_prefactor, c.reduced_mass, speed), speed, c.a});
}

} // namespace

Foresight foresight_of(const Engine &engine, double horizon)
{
  if (horizon <= 0.)
    return {};
  const EngineEnergy energy = engine.energy();
  return {horizon, negligible_impact * (energy.kinetic + energy.elastic),
          engine.parameters().gravity.norm() * horizon};
}

void append(SpringNetwork &network, const SpringContact &c,
            const Foresight &ahead)
{
  note_impact(c, ahead, network.impact);
  const ContactCoefficients &f = c.coefficients;
  // Without friction the shear spring and its dashpot never hold.
  const double shear = f.friction > 0. ? c.shear_stiffness : 0.;
  const double rolling = f.rolling_friction > 0. ? c.shear_stiffness : 0.;
  network.a.push_back(c.a);
  network.b.push_back(c.b);
  network.normal.push_back(c.normal);
  network.lever_a.push_back(c.lever_a);
  network.lever_b.push_back(c.lever_b);
  network.normal_stiffness.push_back(c.normal_stiffness);
  network.shear_stiffness.push_back(shear);
  network.rolling_stiffness.push_back(rolling * c.rolling_radius *
                                      c.rolling_radius);
  network.normal_dashpot.push_back(
      2. * f.normal_damping * std::sqrt(c.reduced_mass * c.normal_stiffness));
  network.shear_dashpot.push_back(2. * f.shear_damping *
                                  std::sqrt(c.reduced_mass * shear));
}

void add_impacts(const Engine &engine, const Foresight &ahead,
                 SpringNetwork &network)
{
  const ParticleSystem &particles = engine.particles();
  const EngineParameters &parameters = engine.parameters();
  const double fastest = largest_of_particles(
      engine, 0.,
      [&particles](std::size_t i) { return particles.velocity(i).norm(); });
  const double speed = 2. * (fastest + ahead.gained_speed);
  if (speed * ahead.horizon <= engine.listed_gap())
    return;
  std::vector<std::int64_t> n_near(particles.size(), 0);
  for (std::size_t k = 0; k < network.n_contacts(); ++k)
  {
    ++n_near[static_cast<std::size_t>(network.a[k])];
    if (const FarShare &far = network.b[k].front();
        far.body >= 0 && static_cast<std::size_t>(far.body) < particles.size())
      ++n_near[static_cast<std::size_t>(far.body)];
  }
  engine.distribution().exchange().collect(n_near);
  const LawChoice of_walls = law_of(parameters.wall),
                  of_pairs = law_of(parameters.particle);
  const bool on_plate = of_walls.entry().scales_with_curvature;
  const LawChoice &law = on_plate ? of_walls : of_pairs;
  if (!law.entry().scales_with_curvature)
    return;
  const ContactCoefficients coefficients =
      on_plate ? coefficients_of(parameters.wall)
               : coefficients_of(parameters.particle);
  const ElasticityTable elasticity(parameters);
  for (std::size_t i = 0; i < particles.n_owned(); ++i)
  {
    if (n_near[i] > 0)
      continue;
    const double curvature = 1. / particles.radius(i),
                 other = on_plate ? 0. : curvature;
    const HertzPrefactors prefactors = elliptic_table()(
        on_plate
            ? elasticity.on_plate(particles.material[i])
            : elasticity.pair(particles.material[i], particles.material[i]),
        gap_coefficients({curvature, curvature, other, other, 1.}));
    const NormalSpring<double> spring = law.entry().spring(
        law.values, {prefactors.normal, prefactors.tangential},
        std::min(speed * ahead.horizon,
                 impact_overlap(prefactors.normal, particles.mass(i), speed)));
    SpringContact c;
    c.a = static_cast<std::int32_t>(i);
    c.lever_a = particles.radius(i) * c.normal;
    c.normal_stiffness = spring.stiffness;
    c.shear_stiffness = spring.shear_stiffness;
    c.hertz_prefactor = prefactors.normal;
    c.closing_speed = speed;
    c.rolling_radius = particles.radius(i);
    c.reduced_mass = particles.mass(i);
    c.coefficients = coefficients;
    append(network, c, ahead);
  }
}
} // namespace dem
