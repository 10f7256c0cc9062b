#include "dem_scene.h"
#include "reference_impacts.h"

#include <gtest/gtest.h>

// A ball on a plane: rolling and sliding of MODEL 5.6. The spring gives way by
// W / k, a share of 1e-5 of the radius or less: lever and radius differ by
// that much.
namespace
{
constexpr double ball_radius = 0.01, gravity = 9.81;

dem::EngineParameters floor_parameters()
{
  dem::EngineParameters p = support::bare_parameters();
  p.wall.normal_stiffness = 2e6;
  p.wall.shear_stiffness = 1.7e6;
  p.wall.friction = 0.5;
  p.wall.normal_damping = p.wall.shear_damping = 0.3;
  p.gravity = {0., 0., -gravity};
  return p;
}

/// A ball that rests on the plane z = 0 by its own weight.
dem::Engine resting_ball(const dem::EngineParameters &parameters)
{
  dem::Engine engine(parameters);
  engine.add_plane(dem::Vec3::Zero(), dem::Vec3::UnitZ());
  support::add_sphere(engine, ball_radius, {0., 0., ball_radius});
  const double sunk =
      engine.particles().mass(0) * gravity / parameters.wall.normal_stiffness;
  engine.particles().position(0).z() -= sunk;
  return engine;
}

double unit_time(const dem::Engine &engine)
{
  return std::sqrt(engine.particles().mass(0) /
                   engine.parameters().wall.normal_stiffness);
}
} // namespace

// Once the shear spring has settled the ball slows down evenly. Velocity
// Verlet is exact for that; 1e-4 leaves room for the lever.
TEST(EngineRolling, DecelerationIsFiveSeventhsOfTheResistance)
{
  dem::EngineParameters p = floor_parameters();
  p.wall.rolling_friction = 0.05;
  dem::Engine engine = resting_ball(p);
  engine.particles().velocity(0).x() = 0.2;
  engine.particles().spin(0).y() = 0.2 / ball_radius;
  const double dt = 0.1 * unit_time(engine);
  support::advance(engine, dt, 1000);
  const double from = engine.particles().velocity(0).x(), at = engine.time();
  support::advance(engine, dt, 10000);
  const double slowed =
      (from - engine.particles().velocity(0).x()) / (engine.time() - at);
  const reference::RollingSphere exact{0.05, gravity};
  EXPECT_GT(engine.particles().velocity(0).x(), 0.1);
  EXPECT_NEAR(slowed / exact.deceleration(), 1., 1e-4);
  // What it loses is rolling resistance; the residual is of second order.
  EXPECT_NEAR(support::energy_residual(engine) +
                  0.7 * 0.04 * engine.particles().mass(0),
              0., 1e-3 * engine.energy().rolling);
}

// A ball thrown flat slides, then rolls at 5/7 of its speed for ever.
TEST(EngineRolling, SlidingTurnsIntoPerfectRolling)
{
  dem::Engine engine = resting_ball(floor_parameters());
  engine.particles().velocity(0).x() = 0.1;
  const double dt = 0.1 * unit_time(engine);
  // It slides for 2/7 v / (mu g) = 5.8 ms.
  support::advance(engine, dt, static_cast<int>(0.02 / dt));
  const double rolling = engine.particles().velocity(0).x();
  EXPECT_NEAR(rolling, 5. / 7. * 0.1, 1e-4 * 0.1);
  for (int step = 0; step < 5000; ++step)
  {
    engine.advance(dt);
    const auto &stones = engine.particles();
    const double lever = stones.position(0).z();
    // The shear spring has come to rest, damped for 60 of its periods.
    ASSERT_NEAR(stones.velocity(0).x() - stones.spin(0).y() * lever, 0., 1e-9);
  }
  EXPECT_NEAR(engine.particles().velocity(0).x(), rolling, 1e-9);
}

// Oblique impact without damping (e = 1), sliding all through: the impulse of
// friction is mu times the normal one, whatever the step. The lever is shorter
// by the overlap, at most v_n sqrt(m / k) = 1e-5 of the radius.
TEST(EngineRolling, GrossSlidingOnAPlane)
{
  dem::EngineParameters p = support::bare_parameters();
  p.wall.friction = 0.1;
  dem::Engine engine(p);
  engine.add_plane(dem::Vec3::Zero(), dem::Vec3::UnitZ());
  support::add_sphere(engine, ball_radius, {0., 0., ball_radius});
  const reference::GrossSliding exact{p.wall.friction, 1., 0.01, ball_radius};
  const double tangential = 2. * exact.least_tangential_speed();
  engine.particles().velocity(0) = {tangential, 0., -exact.normal_speed};
  const double dt = 1e-3 * unit_time(engine);
  do
    engine.advance(dt);
  while (engine.particles().position(0).z() < ball_radius);
  const dem::Vec3 v = engine.particles().velocity(0);
  const dem::Vec3 spin = engine.particles().spin(0);
  EXPECT_NEAR(v.z() / exact.normal_speed, 1., 1e-4);
  EXPECT_NEAR((tangential - v.x()) / exact.tangential_loss(), 1., 1e-3);
  EXPECT_NEAR(spin.y() / exact.spin(), 1., 1e-3);
  EXPECT_NEAR(std::abs(v.y()) + std::abs(spin.x()) + std::abs(spin.z()), 0.,
              1e-12);
}

// Two equal balls: each takes half of the relative sliding; e = 1.
TEST(EngineRolling, GrossSlidingOfTwoBalls)
{
  dem::EngineParameters p = support::bare_parameters();
  p.stone.friction = 0.1;
  p.stone.shear_modulus = 3e10;
  dem::Engine engine(p);
  support::add_sphere(engine, ball_radius, {-ball_radius, 0., 0.});
  support::add_sphere(engine, ball_radius, {ball_radius, 0., 0.});
  const reference::GrossSliding exact{0.1, 1., 0.005, ball_radius};
  const double tangential = 2. * exact.least_tangential_speed();
  engine.particles().velocity(0) = {exact.normal_speed, tangential, 0.};
  engine.particles().velocity(1) = {-exact.normal_speed, -tangential, 0.};
  do
    engine.advance(4e-8);
  while (
      (engine.particles().position(1) - engine.particles().position(0)).norm() <
      2. * ball_radius);
  // The branch turns by 6e-4 while they slide past each other.
  for (const double side : {1., -1.})
  {
    const std::size_t k = side > 0. ? 0 : 1;
    const dem::Vec3 v = engine.particles().velocity(k);
    EXPECT_NEAR((tangential - side * v.y()) / exact.tangential_loss(), 1.,
                1e-3);
    EXPECT_NEAR(std::abs(engine.particles().spin(k).z()) / exact.spin(), 1.,
                1e-3);
  }
  EXPECT_NEAR(engine.particles().spin(0).z(), engine.particles().spin(1).z(),
              1e-9 * exact.spin());
}
