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

/// A box of smooth planes round particles, and what it has reached.
class Closing
{
public:
  Closing(const BenchParticles &particles, const ClosingReport &its_report)
      : material(bench_parameters(particles).particle), report(its_report),
        engine(fill_engine(particles, closing_parameters(particles))),
        box(dem::add_box(*engine, dem::Vec3::Zero(), particles.packing.box))
  {
    reached.step = 1.5 * settling_step(*engine);
  }

  /// Without friction, to three times the pressure.
  void press_together(const Packing &packing)
  {
    drive_evenly(*engine, box, packing);
    do
      run_interval(nullptr);
    while (!is_compact() && engine->time() < closing_time);
  }

  /// With friction under the pressure, for this long and until all rest.
  void hold(double at_least)
  {
    engine->set_friction(material.friction);
    engine->set_local_damping(0.3);
    dem::BoxServo servo(box, {5e-4, closing_speed});
    for (int d = 0; d < 3; ++d)
      servo.follow(d, pressure);
    const double begin = engine->time();
    do
      run_interval(&servo);
    while (engine->time() < begin + at_least ||
           (!is_at_rest() && engine->time() < begin + resting_time));
  }

  /// The box and the particles in it, its lower corner in the origin.
  ClosedBox take(Packing &packing) const
  {
    take_positions(*engine, packing);
    dem::Vec3 lower;
    for (int d = 0; d < 3; ++d)
      lower[d] =
          dem::planes(*engine)[box[static_cast<std::size_t>(d)][0]].point[d];
    for (dem::Vec3 &x : packing.position)
      x -= lower;
    packing.box = dem::box_size(*engine, box);
    return reached;
  }

private:
  /// `servo` drives the walls if there is one.
  void run_interval(dem::BoxServo *servo)
  {
    for (int step = 0; step < closing_interval; ++step)
    {
      if (servo != nullptr)
        servo->update(*engine, reached.step);
      engine->advance(reached.step);
    }
    reached.time = engine->time();
    reached.n_steps = engine->n_steps();
    reached.stress = dem::box_stress(*engine, box);
    reached.unbalanced_ratio = dem::unbalanced_force_ratio(*engine);
    report(reached);
  }

  /// Pressed together well beyond the shock of the first contacts.
  bool is_compact() const
  {
    return reached.stress.minCoeff() > 3. * pressure &&
           dem::solid_volume(engine->particles(), *dem::one_rank()) >
               0.55 * dem::box_size(*engine, box).prod();
  }

  bool is_at_rest() const
  {
    return (reached.stress.array() / pressure - 1.).abs().maxCoeff() < 0.05 &&
           reached.unbalanced_ratio < 0.02;
  }

  dem::ParticleMaterial material;
  const ClosingReport &report;
  std::unique_ptr<dem::Engine> engine;
  dem::BoxPlanes box;
  ClosedBox reached;
};

/// N copies of the box side by side along each axis.
void repeat(BenchParticles &particles, int n)
{
  const Packing one = particles.packing;
  const std::vector<dem::ParticleShape> bodies = particles.bodies;
  Packing &all = particles.packing;
  all.position.clear();
  all.orientation.clear();
  all.radius.clear();
  particles.bodies.clear();
  for (int copy = 0; copy < n * n * n; ++copy)
  {
    const dem::Vec3 from =
        one.box.cwiseProduct(dem::Vec3(copy % n, copy / n % n, copy / n / n));
    for (std::size_t k = 0; k < one.size(); ++k)
    {
      all.position.push_back(one.position[k] + from);
      all.orientation.push_back(one.orientation[k]);
      all.radius.push_back(one.radius[k]);
      particles.bodies.push_back(bodies[k]);
    }
  }
  all.box = static_cast<double>(n) * one.box;
}
} // namespace

ClosedBox close_box(BenchParticles &particles, const ClosingReport &report)
{
  spread(particles);
  Closing closing(particles, report);
  closing.press_together(particles.packing);
  closing.hold(falling_time);
  return closing.take(particles.packing);
}

ClosedBox join_copies(BenchParticles &particles, int n,
                      const ClosingReport &report)
{
  repeat(particles, n);
  Closing closing(particles, report);
  closing.hold(0.);
  return closing.take(particles.packing);
}
} // namespace spall
