#include "check_parts.h"
#include "subgrade.h"

#include <dem/integrate/contact_springs.h>

#include <chrono>
#include <cstdio>

namespace spall
{
namespace
{
/// Wall-clock of one call, the mean of some [s].
template <class Work>
double cost_of(int n, const Work &work)
{
  using Clock = std::chrono::steady_clock;
  work(); // the first one makes lists and factors
  const auto start = Clock::now();
  for (int k = 0; k < n; ++k)
    work();
  return std::chrono::duration<double>(Clock::now() - start).count() / n;
}

/// One step of the stones when they are packed: the cloud is drawn together to
/// the layer and evaluated in place.
double packed_cost(const Case &parameters)
{
  StoneBox scene = make_stone_box(parameters);
  const LayerParameters &l = parameters.subgrade.layer;
  for (dem::StoneState &stone : scene.engine->particles().state)
    stone.position.z() *= l.initial_solid_fraction / l.solid_fraction;
  scene.engine->add_plane(dem::Vec3::Zero(), dem::Vec3::UnitZ());
  return cost_of(100, [&] { scene.engine->advance(1e-15); });
}

/// One window of the ground.
double ground_cost(const Case &parameters, double window)
{
  const CouplingParameters &c = parameters.coupling;
  fem::Solid block = make_ground(parameters);
  std::unique_ptr<coupling::Body> body;
  if (parameters.subgrade.ground.body == GroundBody::full)
    body = std::make_unique<coupling::SolidBody>(
        std::move(block), fem::z_upper,
        coupling::BodySteps{c.is_membrane_implicit, c.membrane_steps});
  else
    body = std::make_unique<coupling::CondensedBody>(
        block, fem::z_upper, parameters.subgrade.ground.inner_modes,
        c.membrane_steps, window);
  const coupling::Field load(body->motion().position.size(),
                             dem::Vec3(0., 0., -1.));
  // A pass predicts and corrects; every_step does it once.
  const double passes = c.exchange == ExchangeChoice::every_step ? 1. : 2.;
  return passes * cost_of(20, [&] { body->advance(load, window); });
}
} // namespace

void check_subgrade_cost(const Case &parameters)
{
  const Subgrade test(parameters);
  print_stones(test.engine());
  const auto [cells, nodes] = test.ground_size();
  std::printf("subgrade         %zu cells, %zu nodes, %s\n", cells, nodes,
              parameters.subgrade.ground.body == GroundBody::full
                  ? "full"
                  : "condensed on the nodes of its top");
  const dem::StepLimit limit =
      dem::critical_step(test.engine().parameters(), test.engine().particles());
  std::printf("time step        %.4g s, stable up to %.4g s (%s)\n",
              test.time_step(), limit.step, limit.reason.c_str());
  std::printf(
      "in a corner      %.4g s (the same stone on three walls)\n",
      dem::corner_step(test.engine().parameters(), test.engine().particles()));
  print_exchange(test.setup_step(), "subgrade");
  const SubgradeLoad load(parameters);
  std::printf("loading          %.4g s of pulses, impulse %.4g N s, then %.4g "
              "s of rest\n",
              load.duration(), load.impulse(), parameters.subgrade.pulse.rest);
  const double window = window_of(parameters, test.time_step());
  const double stones = packed_cost(parameters),
               ground = ground_cost(parameters, window);
  const double steps = test.duration() / test.time_step();
  print_memory();
  std::printf("predicted time   %.3g s for %.4g steps of the loading (%.3g ms "
              "each, and %.3g ms a window), %.3g s for each second of pouring "
              "before\n",
              steps * stones + test.duration() / window * ground, steps,
              1e3 * stones, 1e3 * ground, stones / test.time_step());
}
} // namespace spall
