// What a step of a vibratory compaction will cost, and how long it will be.
#include "run/forecast.h"

#include "compaction/compaction.h"
#include "run/thread_choice.h"

#include <dem/integrate/contact_springs.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace spall
{
namespace
{
constexpr int n_between = 25; // steps between two looks at the contacts
/// A forecast is to be short, if need be a worse one: of each of its parts.
constexpr double patience = 8.; // [s]

/// Runs as long as the contacts allow, at most `longest` at a step [s].
void run_a_little(dem::Engine &engine, double longest)
{
  const dem::SpringNetwork network = dem::contact_springs(engine, 0.);
  const double step =
      std::min(longest, 0.5 * dem::guaranteed_step(network).step);
  for (int k = 0; k < n_between; ++k)
    engine.advance_unseen(step);
}

/// Overlaps of a random packing go until hardly any are left.
void relax(dem::Engine &engine, double longest)
{
  constexpr int n_rounds = 60;
  const Stopwatch spent;
  for (int round = 0; round < n_rounds && spent.seconds() < patience; ++round)
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
  const Stopwatch spent;
  for (int round = 0;
       round < n_rounds && engine.planes()[plate].force.z() < load &&
       spent.seconds() < patience;
       ++round)
    run_a_little(engine, longest);
  engine.planes()[plate].velocity = dem::Vec3::Zero();
  engine.come_to_rest();
  return plate;
}

/// The plate swings as it would on its own, steps are what a run would take.
MeanStep shake(dem::Engine &engine, std::size_t plate, const Case &parameters,
               const dem::StepLimit &limit, double first_step)
{
  constexpr int n_steps = 8000;
  const VibrationParameters &v = parameters.vibration;
  const double omega = 2. * std::numbers::pi * v.frequency;
  const double speed =
      v.eccentric_mass * v.eccentricity * omega / parameters.plate.mass;
  StepWatch watch(parameters.time, limit.step);
  ThreadChoice threads(parameters.threads);
  double step = first_step;
  const double from = engine.time();
  const Stopwatch spent;
  int k = 0;
  for (; k < n_steps && (k == 0 || spent.seconds() < patience); ++k)
  {
    if (watch.is_due(engine.n_steps()))
    {
      watch.look(engine, {}, step);
      step = watch.is_fixed() ? step : watch.state().longest;
    }
    threads.before_step();
    engine.planes()[plate].velocity.z() =
        -speed * std::sin(omega * (engine.time() - from));
    engine.advance_unseen(step);
  }
  return {(engine.time() - from) / k, spent.seconds() / k};
}
} // namespace

void Compaction::print_forecast()
{
  const std::unique_ptr<dem::Engine> packed = packed_engine(parameters, scene);
  relax(*packed, time_step());
  const std::size_t plate_there = press(*packed, weight(), time_step());
  packed->set_local_damping(parameters.time.local_damping);
  MeanStep mean =
      shake(*packed, plate_there, parameters, step_limit(), time_step());
  if (parameters.lateral() == Lateral::membrane)
  {
    fem::Membrane sleeve = make_tube(parameters);
    mean.cost += still_step_cost(sleeve);
  }
  print_predicted(duration(), mean);
}
} // namespace spall
