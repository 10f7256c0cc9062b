// What a step of a vibratory compaction will cost, and how long it will be.
#include "compaction.h"
#include "forecast.h"

#include <dem/integrate/contact_springs.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <numbers>

namespace spall
{
namespace
{
constexpr int n_between = 25; // steps between two looks at the contacts

/// Runs as long as the contacts allow, at most `longest` at a step [s].
void run_a_little(dem::Engine &engine, double longest)
{
  const dem::SpringNetwork network = dem::contact_springs(engine, 0.);
  const double step =
      std::min(longest, 0.5 * dem::guaranteed_step(network).step);
  for (int k = 0; k < n_between; ++k)
    engine.advance(step);
}

/// Overlaps of a random packing go until hardly any are left.
void relax(dem::Engine &engine, double longest)
{
  constexpr int n_rounds = 60;
  for (int round = 0; round < n_rounds; ++round)
  {
    run_a_little(engine, longest);
    engine.come_to_rest();
  }
}

/// A plate comes down until the stones carry the load [N]; its plane.
std::size_t press(dem::Engine &engine, double load, double longest)
{
  constexpr int n_rounds = 2000;
  constexpr double speed = 0.1; // [m/s]
  const std::size_t plate =
      engine.add_plane(dem::top_of(engine.particles(), 0.) * dem::Vec3::UnitZ(),
                       -dem::Vec3::UnitZ());
  engine.planes()[plate].velocity = -speed * dem::Vec3::UnitZ();
  for (int round = 0;
       round < n_rounds && engine.planes()[plate].force.z() < load; ++round)
    run_a_little(engine, longest);
  engine.planes()[plate].velocity = dem::Vec3::Zero();
  engine.come_to_rest();
  return plate;
}
} // namespace

/// The packing is pressed, then the plate swings as it would on its own.
void Compaction::print_forecast()
{
  const std::unique_ptr<dem::Engine> packed = packed_engine(parameters, scene);
  relax(*packed, time_step());
  const std::size_t plane = press(*packed, weight(), time_step());
  packed->set_local_damping(parameters.time.local_damping);
  const VibrationParameters &v = parameters.vibration;
  const double omega = 2. * std::numbers::pi * v.frequency;
  const double speed =
      v.eccentric_mass * v.eccentricity * omega / parameters.plate.mass;
  StepWatch looks(parameters.time, step_limit().step);
  double length = time_step();
  const double from = packed->time();
  const auto start = std::chrono::steady_clock::now();
  constexpr int n_steps = 8000;
  for (int k = 0; k < n_steps; ++k)
  {
    if (looks.is_due(packed->n_steps()))
    {
      looks.look(*packed, {}, length);
      if (parameters.time.step != StepRule::fixed)
        length = looks.state().longest;
    }
    packed->planes()[plane].velocity.z() =
        -speed * std::sin(omega * (packed->time() - from));
    packed->advance(length);
  }
  double cost =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start)
          .count() /
      n_steps;
  const double mean_step = (packed->time() - from) / n_steps;
  if (parameters.lateral() == Lateral::membrane)
  {
    fem::Membrane sleeve = make_tube(parameters);
    cost += still_step_cost(sleeve);
  }
  const double n = duration() / mean_step;
  std::printf("predicted time   %.3g s for %.4g steps of %.3g s after the "
              "filling (%.3g ms each)\n",
              cost * n, n, mean_step, 1e3 * cost);
}
} // namespace spall
