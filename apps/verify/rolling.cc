#include "families.h"
#include "reference_impacts.h"
#include "scenes.h"

#include <dem/engine_boundaries.h>

#include <algorithm>
#include <cmath>

// A ball on a plane: closed forms of rolling and sliding. The spring gives way
// by W / k, a share of 1e-5 of the radius or less: lever and radius differ by
// that much.
namespace spall::verify
{
namespace
{
constexpr double sphere_radius = 0.01, gravity = 9.81;

dem::EngineParameters floor_parameters()
{
  dem::EngineParameters p = bare_parameters();
  p.wall.normal_stiffness = 2e6;
  p.wall.shear_stiffness = 1.7e6;
  p.wall.friction = 0.5;
  p.wall.normal_damping = p.wall.shear_damping = 0.3;
  p.gravity = {0., 0., -gravity};
  return p;
}

/// A ball that rests on the plane z = 0 by its own weight.
dem::Engine resting_ball(const dem::EngineParameters &parameters, double radius)
{
  dem::Engine engine(parameters);
  dem::add_plane(engine, dem::Vec3::Zero(), dem::Vec3::UnitZ());
  add_sphere(engine, radius, {0., 0., radius});
  engine.particles().position(0).z() += engine.particles().mass(0) *
                                        parameters.gravity.z() /
                                        parameters.wall.normal_stiffness;
  return engine;
}

double unit_time(const dem::Engine &engine)
{
  return std::sqrt(engine.particles().mass(0) /
                   engine.parameters().wall.normal_stiffness);
}

// Once the shear spring has settled the ball slows down evenly. Velocity
// Verlet is exact for that; 1e-4 leaves room for the lever.
std::vector<Row> resistance()
{
  dem::EngineParameters p = floor_parameters();
  p.wall.rolling_friction = 0.05;
  dem::Engine engine = resting_ball(p, sphere_radius);
  engine.particles().velocity(0).x() = 0.2;
  engine.particles().spin(0).y() = 0.2 / sphere_radius;
  const double start = 0.7 * 0.04 * engine.particles().mass(0);
  const double dt = 0.1 * unit_time(engine);
  advance(engine, dt, 1000);
  const double from = engine.particles().velocity(0).x(), at = engine.time();
  advance(engine, dt, 10000);
  const double slowed =
      (from - engine.particles().velocity(0).x()) / (engine.time() - at);
  const reference::RollingSphere exact{0.05, gravity};
  return {
      {"deceleration 5/7 mu_r g", "m/s^2", exact.deceleration(), slowed, 1e-4},
      at_most("energy residual over the loss by rolling", "-",
              (energy_residual(engine) + start) / engine.energy().rolling,
              1e-3)};
}

// R 2.6 mm, mu_r 0.2, 0.15 m/s, steps of 0.5 us (Chung & Ooi's list, test 12 of
// its continuation); the rule is the settling of the shear spring at the start,
// a few of its periods (50 us).
std::vector<Row> wensrich()
{
  const double radius = 2.6e-3, speed = 0.15;
  dem::EngineParameters p = floor_parameters();
  p.particle.density = 1.;
  p.wall.normal_stiffness = 1e3;
  p.wall.shear_stiffness = 0.85e3;
  p.wall.rolling_friction = 0.2;
  dem::Engine engine = resting_ball(p, radius);
  engine.particles().velocity(0).x() = speed;
  engine.particles().spin(0).y() = speed / radius;
  const reference::RollingSphere exact{0.2, gravity};
  std::vector<Row> rows;
  for (int k = 1; k <= 5; ++k)
  {
    advance(engine, 5e-7, 40000);
    const double left = speed - exact.deceleration() * engine.time();
    const std::string at = " at " + std::to_string(20 * k) + " ms";
    rows.push_back({"spin" + at, "rad/s", left / radius,
                    engine.particles().spin(0).y(), 5e-4, speed / radius});
    rows.push_back({"speed" + at, "m/s", left,
                    engine.particles().velocity(0).x(), 5e-4, speed});
  }
  return rows;
}

/// Way of a ball that starts rolling, and its speed once at rest.
std::vector<Row> stopping()
{
  dem::EngineParameters p = floor_parameters();
  p.wall.rolling_friction = 0.2;
  dem::Engine engine = resting_ball(p, sphere_radius);
  engine.particles().velocity(0).x() = 0.1;
  engine.particles().spin(0).y() = 0.1 / sphere_radius;
  const reference::RollingSphere exact{0.2, gravity};
  const double dt = 0.1 * unit_time(engine);
  advance(engine, dt, static_cast<int>(0.1 / dt)); // stops after 0.0714 s
  return {{"way until rest", "m", exact.stop_distance(0.1),
           engine.particles().position(0).x(), 1e-3},
          at_most("speed after it over the first", "-",
                  engine.particles().velocity(0).x() / 0.1, 1e-3)};
}

// A ball thrown flat slides, then rolls at 5/7 of its speed for ever; the shear
// spring has come to rest, damped for 60 of its periods.
std::vector<Row> sliding_to_rolling()
{
  dem::Engine engine = resting_ball(floor_parameters(), sphere_radius);
  engine.particles().velocity(0).x() = 0.1;
  const double dt = 0.1 * unit_time(engine);
  advance(engine, dt, static_cast<int>(0.02 / dt)); // slides for 5.8 ms
  const double rolling = engine.particles().velocity(0).x();
  double slip = 0.;
  for (int step = 0; step < 5000; ++step)
  {
    engine.advance(dt);
    const auto &ball = engine.particles();
    slip = std::max(slip, std::abs(ball.velocity(0).x() -
                                   ball.spin(0).y() * ball.position(0).z()));
  }
  return {{"speed of rolling, 5/7 of the throw", "m/s", 5. / 7. * 0.1, rolling,
           1e-4},
          at_most("slip speed at the contact", "m/s", slip, 1e-9),
          at_most("loss of speed in 5000 steps", "m/s",
                  rolling - engine.particles().velocity(0).x(), 1e-9)};
}

/// Acceleration down a slope, the plane kept and gravity turned [m/s^2].
double downhill(double degrees, double rolling_friction)
{
  const double angle = degrees * std::numbers::pi / 180.;
  dem::EngineParameters p = floor_parameters();
  p.wall.rolling_friction = rolling_friction;
  p.gravity = gravity * dem::Vec3(std::sin(angle), 0., -std::cos(angle));
  dem::Engine engine = resting_ball(p, sphere_radius);
  const double dt = 0.1 * unit_time(engine);
  advance(engine, dt, 4000);
  const double from = engine.particles().velocity(0).x(), at = engine.time();
  advance(engine, dt, 10000);
  return (engine.particles().velocity(0).x() - from) / (engine.time() - at);
}

std::vector<Row> incline()
{
  std::vector<Row> rows;
  for (const double degrees : {15., 25.})
    rows.push_back(
        {"acceleration, " + std::to_string(int(degrees)) + " degrees, mu_r 0.2",
         "m/s^2",
         reference::RollingSphere{0.2, gravity}.incline_acceleration(
             degrees * std::numbers::pi / 180.),
         downhill(degrees, 0.2), 1e-3});
  rows.push_back(at_most("acceleration, 5 degrees, mu_r 0.2", "m/s^2",
                         downhill(5., 0.2), 1e-3));
  // 2/7 tan 65 degrees > mu: it slips, g cos (tan - mu).
  const double steep = 65. * std::numbers::pi / 180.;
  rows.push_back({"slipping, 65 degrees, mu 0.5", "m/s^2",
                  gravity * (std::sin(steep) - 0.5 * std::cos(steep)),
                  downhill(65., 0.), 1e-3});
  return rows;
}

// Oblique impact on a linear wall without damping, sliding all through: the
// impulse of friction is mu times the normal one, whatever the step. The lever
// is shorter by the overlap, at most v_n sqrt(m / k) = 1e-5 of the radius.
std::vector<Row> gross_sliding()
{
  dem::EngineParameters p = bare_parameters();
  p.wall.friction = 0.1;
  dem::Engine engine(p);
  dem::add_plane(engine, dem::Vec3::Zero(), dem::Vec3::UnitZ());
  add_sphere(engine, sphere_radius, {0., 0., sphere_radius});
  const reference::GrossSliding exact{0.1, 1., 0.01, sphere_radius};
  const double tangential = 2. * exact.least_tangential_speed();
  engine.particles().velocity(0) = {tangential, 0., -exact.normal_speed};
  const double dt = 1e-3 * unit_time(engine);
  do
    engine.advance(dt);
  while (engine.particles().position(0).z() < sphere_radius);
  const dem::Vec3 v = engine.particles().velocity(0);
  const dem::Vec3 spin = engine.particles().spin(0);
  return {{"normal speed after", "m/s", exact.normal_speed, v.z(), 1e-4},
          {"loss of tangential speed", "m/s", exact.tangential_loss(),
           tangential - v.x(), 1e-3},
          {"spin", "rad/s", exact.spin(), spin.y(), 1e-3},
          at_most("what should stay zero", "m/s, rad/s",
                  std::abs(v.y()) + std::abs(spin.x()) + std::abs(spin.z()),
                  1e-12)};
}

/// Angular frequency of a rocking mode lambda k_s / m, from zero crossings.
double rocking_frequency(double lambda)
{
  dem::EngineParameters p = floor_parameters();
  p.wall.friction = p.wall.rolling_friction = 1e3; // nothing slides
  p.wall.normal_damping = p.wall.shear_damping = 0.;
  dem::Engine engine = resting_ball(p, sphere_radius);
  constexpr double speed = 1e-6;
  engine.particles().velocity(0).x() = speed;
  engine.particles().spin(0).y() = (1. - lambda) * speed / sphere_radius;
  const double dt = 0.005 * unit_time(engine);
  double first = 0., last = 0., before = speed;
  constexpr int n_crossings = 21;
  for (int n = 0; n < n_crossings;)
  {
    engine.advance(dt);
    const double now = engine.particles().velocity(0).x();
    if (before * now < 0.)
    {
      last = engine.time() - dt * now / (now - before);
      first = n++ == 0 ? last : first;
    }
    before = now;
  }
  return std::numbers::pi * (n_crossings - 1) / (last - first);
}

// (omega dt)^2 / 24 of the integrator: 5e-6; the lever: 1e-5.
std::vector<Row> rocking()
{
  const double mass = reference::sphere_mass(2750., sphere_radius);
  const reference::RockingModes exact = reference::rocking_modes(1.7e6, mass);
  const double root = std::sqrt(6.5);
  return {
      {"slow mode", "rad/s", exact.slow, rocking_frequency(3. - root), 1e-4},
      {"fast mode", "rad/s", exact.fast, rocking_frequency(3. + root), 1e-4}};
}
} // namespace

Family rolling()
{
  return {"rolling",
          "Rolling and sliding of a ball on a plane, in the engine.",
          {{"resistance", "deceleration 5/7 mu_r g", resistance},
           {"wensrich", "decay of spin, v_0 - 5/7 mu_r g t", wensrich},
           {"stopping", "7 v_0^2 / (10 mu_r g)", stopping},
           {"sliding_to_rolling", "angular momentum about the contact",
            sliding_to_rolling},
           {"incline", "5/7 g cos (tan - mu_r); g cos (tan - mu)", incline},
           {"gross_sliding", "impulse mu (1 + e) v_n", gross_sliding},
           {"rocking", "eigenvalues of lambda^2 - 6 lambda + 5/2", rocking}}};
}
} // namespace spall::verify
