#pragma once

#include "coupled_scene.h"

#include <dem/engine_boundaries.h>

/// A light plate pressed on a heavy particle: one spring, whose gain
/// k dt^2 / (4 m) is set.
namespace support::gain
{
inline constexpr double stiffness = 1e6, radius = 0.05, plate_mass = 1e-4;

struct Way
{
  coupling::ExchangeRule rule = coupling::ExchangeRule::every_step;
  coupling::RelaxationParameters relaxation;
  int particle_steps = 1;
  double damping = 0.;
};

struct Outcome
{
  double growth = 0.;       ///< largest swing, late over early [-]
  double passes = 0.;       ///< per window [-]
  double energy_error = 0.; ///< work, see LedgerSums::work_residual [-]
};

/// The plate swings about its rest; the particle is 1e4 times as heavy.
inline Outcome swing(double gain, const Way &way, int n_windows = 1500)
{
  dem::EngineParameters p = support::bare_parameters();
  p.surface.normal_stiffness = stiffness;
  // The engine takes a rigid body for a wall, with the mass of the particle
  // alone.
  const double particle_mass =
      p.particle.density * 4. / 3. * M_PI * std::pow(radius, 3);
  p.surface.normal_damping =
      way.damping * std::sqrt(plate_mass / particle_mass);
  dem::Engine engine(p);
  support::add_sphere(engine, radius, {0., 0., -radius});
  coupling::ExchangeParameters rules;
  rules.rule = way.rule;
  rules.relaxation = way.relaxation;
  rules.particle_steps = way.particle_steps;
  rules.tolerance = 1e-13;
  rules.max_passes = 400;
  rules.ledger_limit = std::numeric_limits<double>::infinity();
  coupling::Exchange exchange(rules);
  const double sunk = 1e-4;
  const fem::SurfaceMesh mesh = support::square_at(0.02, -0.99 * sunk);
  coupling::RigidDrive drive;
  drive.load = [sunk](double)
  {
    fem::PlateLoad load;
    load.force.z() = -stiffness * sunk;
    return load;
  };
  exchange.add(std::make_unique<coupling::RigidBody>(
                   support::upright(plate_mass), mesh.nodes, drive),
               mesh, "plate", p.surface, coupling::ParticleSide::inside,
               engine);
  const auto particles = coupling::particles_of(engine, support::no_shapes());
  const double window = 2. * std::sqrt(gain * plate_mass / stiffness);
  // The load that is there before the first window.
  for (int step = 0; step < 3; ++step)
    exchange.advance(particles, 1e-6 * window);
  double early = 0., late = 0.;
  for (int step = 0; step < n_windows; ++step)
  {
    exchange.advance(particles, window);
    const double swing_now =
        std::abs(engine.particles().position(0).z() + radius -
                 dem::surface(engine).position[0].z() - sunk);
    double &largest = step < n_windows / 2 ? early : late;
    largest = std::max(largest, swing_now);
    if (swing_now > sunk) // has left the particle
      return {1e9, 0., 0.};
  }
  return {late / early,
          double(exchange.n_passes()) / double(exchange.n_windows()),
          exchange.ledger().work_residual()};
}

inline Way one_pass(int particle_steps = 1)
{
  return {coupling::ExchangeRule::one_pass, {}, particle_steps};
}

inline Way iterated(coupling::RelaxationKind kind, double factor,
                    int particle_steps = 1)
{
  return {coupling::ExchangeRule::iterated, {kind, factor}, particle_steps};
}
} // namespace support::gain
