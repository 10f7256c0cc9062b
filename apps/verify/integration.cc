#include "families.h"
#include "scenes.h"

#include <dem/engine_boundaries.h>

#include <algorithm>
#include <cmath>
#include <random>

// The integrator: its order in translation and rotation, and what it does to
// the energy of collisions.
namespace spall::verify
{
namespace
{
constexpr double sphere_radius = 0.01; // [m]

/// Order from errors, or differences, at a step and half of it.
double order(double coarse, double fine)
{
  return std::log2(std::abs(coarse / fine));
}

/// A ball pressed against a floor by a weight, so that it never leaves; the
/// springs are undamped and nothing slides.
dem::Engine pressed_sphere()
{
  dem::EngineParameters p = bare_parameters();
  p.wall.normal_stiffness = 1e6;
  p.wall.shear_stiffness = 0.7e6;
  p.wall.friction = p.wall.rolling_friction = 1e3;
  p.gravity = {0., 0., -100.};
  dem::Engine engine(p);
  dem::add_plane(engine, dem::Vec3::Zero(), dem::Vec3::UnitZ());
  // A series: balls without one keep their orientation.
  engine.add_particle(body_of(sphere_series(2, sphere_radius)),
                      {0., 0., sphere_radius}, dem::Quaternion::Identity());
  const double mass = engine.particles().mass(0);
  engine.particles().position(0).z() -= mass * 100. / 1e6;
  engine.particles().load[0].force.z() = mass * 100.;
  return engine;
}

double normal_frequency(const dem::Engine &engine)
{
  return std::sqrt(1e6 / engine.particles().mass(0));
}

/// Error of the height after three and a third periods [m].
double bounce_error(int n_steps)
{
  dem::Engine engine = pressed_sphere();
  const double rest = engine.particles().position(0).z(), speed = 1e-3;
  engine.particles().velocity(0).z() = speed;
  const double omega = normal_frequency(engine);
  const double time = 21. / omega;
  advance(engine, time / n_steps, n_steps);
  return std::abs(engine.particles().position(0).z() - rest -
                  speed / omega * std::sin(omega * time));
}

/// Position [m] and angle [rad] of the slow rocking mode after a period and
/// more.
struct Rocking
{
  double position = 0., angle = 0.;
};

Rocking rock(int n_steps)
{
  dem::Engine engine = pressed_sphere();
  const double lambda = 3. - std::sqrt(6.5), speed = 1e-2;
  engine.particles().velocity(0).x() = speed;
  engine.particles().spin(0).y() = (1. - lambda) * speed / sphere_radius;
  const double omega = std::sqrt(0.7 * lambda) * normal_frequency(engine);
  advance(engine, 7.5 / omega / n_steps, n_steps);
  const dem::Quaternion &q = engine.particles().orientation(0);
  return {engine.particles().position(0).x(), 2. * std::atan2(q.y(), q.w())};
}

// Leading error (omega dt)^2 / 24 of the phase; the next order leaves 1e-3. The
// lever of the rocking is short by the overlap, 1e-4 of the radius: its order
// is taken from differences under halved steps.
std::vector<Row> orders()
{
  const Rocking coarse = rock(100), middle = rock(200), fine = rock(400);
  return {{"order, translation (bounce)", "-", 2.,
           order(bounce_error(400), bounce_error(800)), 0.01},
          {"order, translation (rocking)", "-", 2.,
           order(coarse.position - middle.position,
                 middle.position - fine.position),
           0.01},
          {"order, rotation (rocking)", "-", 2.,
           order(coarse.angle - middle.angle, middle.angle - fine.angle),
           0.01}};
}

/// A ball that rocks along x and turns about z and rocks along y at another
/// phase: its axis moves. Orientation at the end.
dem::Quaternion tumbling(int n_steps)
{
  dem::Engine engine = pressed_sphere();
  const double speed = 0.02;
  engine.particles().velocity(0) = {speed, 0.4 * speed, 0.};
  engine.particles().spin(0) = {0.3 * speed / sphere_radius,
                                0.8 * speed / sphere_radius, 150.};
  const double time = 20. / normal_frequency(engine);
  advance(engine, time / n_steps, n_steps);
  return engine.particles().orientation(0);
}

double angle_between(const dem::Quaternion &a, const dem::Quaternion &b)
{
  return a.angularDistance(b);
}

// Differences of neighbours in a sequence of halved steps fall by 4.
std::vector<Row> moving_axis()
{
  const dem::Quaternion coarse = tumbling(800), middle = tumbling(1600),
                        fine = tumbling(3200), finest = tumbling(6400);
  return {
      {"order, orientation, from differences", "-", 2.,
       order(angle_between(coarse, middle), angle_between(middle, fine)), 0.05},
      {"order, one level finer", "-", 2.,
       order(angle_between(middle, fine), angle_between(fine, finest)), 0.03}};
}

/// Balls of 7 to 22 mm that fly about in a box of six planes.
dem::Engine gas(double box, double wall_stiffness)
{
  dem::EngineParameters p = bare_parameters();
  p.wall.normal_stiffness = wall_stiffness;
  dem::Engine engine(p);
  for (int axis = 0; axis < 3; ++axis)
    for (const double side : {-1., 1.})
      dem::add_plane(engine, side * 0.5 * box * dem::Vec3::Unit(axis),
                     -side * dem::Vec3::Unit(axis));
  std::mt19937 generator(7);
  std::uniform_real_distribution<double> some(-1., 1.);
  for (int k = 0; k < 27; ++k)
  {
    const dem::Vec3 cell(k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1);
    add_sphere(engine, 0.5 * (0.0145 + 0.0075 * some(generator)),
               box / 3. * cell);
    for (int c = 0; c < 3; ++c)
      engine.particles().last().velocity(c) = some(generator);
  }
  return engine;
}

struct Drift
{
  double residual = 0.; ///< largest, over the first energy [-]
  int n_impacts = 0;    ///< ball on ball and on walls
};

Drift run_gas(double wall_stiffness, double time_step)
{
  dem::Engine engine = gas(0.075, wall_stiffness);
  const double start = engine.energy().kinetic;
  Drift drift;
  std::size_t touching = 0;
  while (engine.time() < 0.05)
  {
    engine.advance(time_step);
    std::size_t now = 0;
    for (const dem::ContactBatch *batch :
         {&engine.pairs(), &dem::on_planes(engine)})
      for (std::size_t k = 0; k < batch->size(); ++k)
        now += batch->is_touching(k);
    drift.n_impacts += now > touching ? static_cast<int>(now - touching) : 0;
    const bool is_free = now == 0 && touching == 0;
    touching = now;
    const dem::EngineEnergy e = engine.energy();
    // Half of what the last force is taken back by acts in the next step.
    if (is_free)
      drift.residual =
          std::max(drift.residual, std::abs(e.kinetic / start - 1.));
  }
  return drift;
}

// 1 us is the default of Time/fixed_step. An impact of the smallest ball on the
// default wall of 1e8 N/m lasts 7 steps of it, one of two balls some 100.
std::vector<Row> energy_drift()
{
  std::vector<Row> rows;
  const struct
  {
    const char *name;
    double stiffness, time_step;
  } runs[] = {{"1 us, walls of 1e5 N/m", 1e5, 1e-6},
              {"1 us, walls of 1e8 N/m", 1e8, 1e-6},
              {"2 us, walls of 1e8 N/m", 1e8, 2e-6}};
  for (const auto &run : runs)
  {
    const Drift drift = run_gas(run.stiffness, run.time_step);
    rows.push_back(at_most(std::string("kinetic energy, ") + run.name + ", " +
                               std::to_string(drift.n_impacts) + " impacts",
                           "-", drift.residual, 1e-4));
  }
  return rows;
}

/// A ball flies into a corner of linear walls; `phase` of a step passes until
/// it touches the first.
struct CornerImpact
{
  double time_step = 0.; ///< over sqrt(m / k) [-]
  double phase = 0.;     ///< 0 .. 1 [-]
};

/// Kinetic energy after the impacts over that before [-].
double energy_kept(const CornerImpact &impact)
{
  dem::EngineParameters p = bare_parameters();
  p.wall.normal_stiffness = 1e8;
  dem::Engine engine(p);
  for (int axis = 0; axis < 2; ++axis)
    dem::add_plane(engine, dem::Vec3::Zero(), dem::Vec3::Unit(axis));
  add_sphere(engine, sphere_radius, dem::Vec3::Constant(sphere_radius));
  const double dt =
      impact.time_step * std::sqrt(engine.particles().mass(0) / 1e8);
  dem::Vec3 &velocity = engine.particles().velocity(0);
  velocity = {-1., -0.7, 0.};
  engine.particles().position(0) -= dt * impact.phase * velocity;
  engine.particles().position(0).y() += 0.13 * dt;
  const double start = engine.energy().kinetic;
  advance(engine, dt, 5 + static_cast<int>(std::ceil(5. / impact.time_step)));
  return engine.energy().kinetic / start;
}

/// Largest change of the energy over 200 phases.
double worst_change(double time_step)
{
  double worst = 0.;
  for (int k = 0; k < 200; ++k)
    worst = std::max(worst,
                     std::abs(energy_kept({time_step, (k + 0.5) / 200.}) - 1.));
  return worst;
}

// Whatever the step: round-off of positions of 1 cm, overlaps being
// micrometres.
std::vector<Row> linear_impacts()
{
  std::vector<Row> rows;
  for (const double step : {0.05, 0.5, 1., 1.4})
    rows.push_back(
        at_most("energy lost, omega dt = " + std::to_string(step).substr(0, 4),
                "-", worst_change(step), 1e-11));
  return rows;
}
} // namespace

Family integration()
{
  return {
      "integration",
      "The integrator of the engine: velocity Verlet with quaternions.",
      {{"orders", "harmonic motion; eigenmode of rocking", orders},
       {"moving_axis", "differences under halved steps", moving_axis},
       {"linear_impacts",
        "undamped, into a corner, 200 phases: nothing is lost", linear_impacts},
       {"energy_drift", "undamped, without friction: nothing is lost",
        energy_drift}}};
}
} // namespace spall::verify
