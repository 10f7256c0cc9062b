// What a step of a vibratory compaction will cost, and how long it will be.
#include "compaction.h"
#include "forecast.h"

#include <dem/integrate/contact_springs.h>

#include <algorithm>
#include <cstdio>

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

/// A plate comes down until the stones carry the load [N].
void press(dem::Engine &engine, double load, double longest)
{
  constexpr int n_rounds = 400;
  constexpr double speed = 1.; // [m/s]
  const std::size_t plate =
      engine.add_plane(dem::top_of(engine.particles(), 0.) * dem::Vec3::UnitZ(),
                       -dem::Vec3::UnitZ());
  engine.planes()[plate].velocity = -speed * dem::Vec3::UnitZ();
  for (int round = 0;
       round < n_rounds && engine.planes()[plate].force.z() < load; ++round)
    run_a_little(engine, longest);
  engine.planes()[plate].velocity = dem::Vec3::Zero();
  engine.come_to_rest();
}
} // namespace

void Compaction::print_forecast()
{
  const std::unique_ptr<dem::Engine> packed = packed_engine(parameters, scene);
  relax(*packed, time_step());
  press(*packed, weight(), time_step());
  double longest = time_step();
  if (parameters.time.step != StepRule::fixed)
    longest = std::min(
        longest,
        parameters.time.safety *
            dem::guaranteed_step(dem::contact_springs(*packed, 0.)).step);
  double cost = still_step_cost(*packed);
  if (parameters.lateral() == Lateral::membrane)
  {
    fem::Membrane sleeve = make_tube(parameters);
    cost += still_step_cost(sleeve);
  }
  std::printf("predicted time   %.3g s for %.4g steps of %.3g s after the "
              "filling (%.3g ms each)\n",
              cost * duration() / longest, duration() / longest, longest,
              1e3 * cost);
}
} // namespace spall
