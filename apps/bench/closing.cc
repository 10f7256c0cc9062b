#include "bench/closing.h"

#include "bench/state.h"
#include "specimen/specimen.h"

#include <dem/engine_boundaries.h>
#include <dem/measure/assembly.h>

#include <algorithm>
#include <cmath>

namespace spall
{
namespace
{
constexpr double pressure = 30e3;     // of the closed box [Pa]
constexpr double closing_speed = 2.;  // of one wall at most [m/s]
constexpr double closing_time = 0.05; // to be pressed together, at most [s]
constexpr double falling_time = 0.08; // in which small particles fall [s]
constexpr double resting_time = 0.15; // to come to rest, at most [s]
constexpr int closing_interval = 200; // [steps]

/// Smooth walls, particles without friction until they are pressed together.
dem::EngineParameters closing_parameters(const BenchParticles &particles)
{
  dem::EngineParameters parameters = bench_parameters(particles);
  parameters.particle.friction = 0.;
  parameters.wall.friction = parameters.wall.rolling_friction = 0.;
  parameters.local_damping = 0.7;
  return parameters;
}

/// Moves everything away from the origin so that the circumscribed spheres of
/// particles whose balls touch come apart.
void spread(BenchParticles &particles)
{
  Packing &packing = particles.packing;
  double factor = 1.;
  for (std::size_t k = 0; k < packing.size(); ++k)
    factor = std::max(factor, particles.bodies[k].circumscribed_radius /
                                  packing.radius[k]);
  packing.box *= factor;
  for (dem::Vec3 &x : packing.position)
    x *= factor;
}

/// The particles come together as fast as the walls, so that the box closes
/// evenly.
void drive_evenly(dem::Engine &engine, const dem::BoxPlanes &box,
                  const Packing &packing)
{
  const dem::Vec3 centre = 0.5 * packing.box;
  std::vector<dem::Vec3> velocities;
  for (const dem::Vec3 &x : packing.position)
    velocities.emplace_back(closing_speed * (centre - x).cwiseQuotient(centre));
  set_velocities(engine, velocities);
  for (int d = 0; d < 3; ++d)
  {
    const auto &[lower, upper] = box[static_cast<std::size_t>(d)];
    dem::planes(engine)[lower].velocity = closing_speed * dem::Vec3::Unit(d);
    dem::planes(engine)[upper].velocity = -closing_speed * dem::Vec3::Unit(d);
  }
}

/// Some steps of closing; `servo` drives the walls if there is one.
void run_interval(dem::Engine &engine, const dem::BoxPlanes &box,
                  dem::BoxServo *servo, ClosedBox &reached)
{
  for (int step = 0; step < closing_interval; ++step)
  {
    if (servo != nullptr)
      servo->update(engine, reached.step);
    engine.advance(reached.step);
  }
  reached.time = engine.time();
  reached.n_steps = engine.n_steps();
  reached.stress = dem::box_stress(engine, box);
  reached.unbalanced_ratio = dem::unbalanced_force_ratio(engine);
}

/// Pressed together well beyond the shock of the first contacts.
bool is_compact(const dem::Engine &engine, const dem::BoxPlanes &box,
                const ClosedBox &reached)
{
  return reached.stress.minCoeff() > 3. * pressure &&
         dem::solid_volume(engine.particles(), *dem::one_rank()) >
             0.55 * dem::box_size(engine, box).prod();
}

bool is_at_rest(const ClosedBox &reached)
{
  return (reached.stress.array() / pressure - 1.).abs().maxCoeff() < 0.05 &&
         reached.unbalanced_ratio < 0.02;
}

/// The box and the particles in it, its lower corner in the origin.
void take_closed(const dem::Engine &engine, const dem::BoxPlanes &box,
                 Packing &packing)
{
  take_positions(engine, packing);
  dem::Vec3 lower;
  for (int d = 0; d < 3; ++d)
    lower[d] =
        dem::planes(engine)[box[static_cast<std::size_t>(d)][0]].point[d];
  for (dem::Vec3 &x : packing.position)
    x -= lower;
  packing.box = dem::box_size(engine, box);
}
} // namespace

ClosedBox close_box(BenchParticles &particles,
                    const std::function<void(const ClosedBox &)> &report)
{
  spread(particles);
  const std::unique_ptr<dem::Engine> engine =
      fill_engine(particles, closing_parameters(particles));
  const dem::BoxPlanes box =
      dem::add_box(*engine, dem::Vec3::Zero(), particles.packing.box);
  drive_evenly(*engine, box, particles.packing);
  ClosedBox reached;
  reached.step = 1.5 * settling_step(*engine);
  const auto run = [&](dem::BoxServo *servo)
  {
    run_interval(*engine, box, servo, reached);
    report(reached);
  };
  do
    run(nullptr);
  while (!is_compact(*engine, box, reached) && engine->time() < closing_time);
  engine->set_friction(bench_parameters(particles).particle.friction);
  engine->set_local_damping(0.3);
  dem::BoxServo servo(box, {5e-4, closing_speed});
  for (int d = 0; d < 3; ++d)
    servo.follow(d, pressure);
  const double pressed = engine->time();
  do
    run(&servo);
  while (engine->time() < pressed + falling_time ||
         (!is_at_rest(reached) && engine->time() < pressed + resting_time));
  take_closed(*engine, box, particles.packing);
  return reached;
}
} // namespace spall
