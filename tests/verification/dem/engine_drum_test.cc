#include "dem_scene.h"

#include <dem/boundary/drum.h>
#include <dem/engine_boundaries.h>

#include <gtest/gtest.h>

// A drum that turns about the y axis, gravity along -z.
namespace
{
constexpr double gravity = 9.81; // [m/s^2]

dem::Drum plain_drum()
{
  dem::Drum drum;
  drum.radius = 0.3;
  drum.length = 0.4;
  return drum;
}

dem::EngineParameters drum_parameters()
{
  dem::EngineParameters p = support::bare_parameters();
  p.wall.normal_stiffness = 1e5;
  p.wall.shear_stiffness = 0.85e5;
  p.gravity = -gravity * dem::Vec3::UnitZ();
  return p;
}

double energy_residual(const dem::Engine &engine)
{
  return support::energy_residual(engine) + engine.energy().work_of("drum");
}
} // namespace

// Without friction a ball swings on the cylinder as a pendulum of the length
// R - r: period 2 pi sqrt((R - r) / g) (1 + a^2 / 16). Half a period is seen as
// the time between two turning points; the wall gives by 6e-6 of the length.
TEST(EngineDrum, BallSwingsAsAPendulum)
{
  dem::Engine engine(drum_parameters());
  dem::set_drum(engine, plain_drum());
  const double r = 0.02, length = plain_drum().radius - r, angle = 0.1;
  support::add_sphere(
      engine, r, length * dem::Vec3(std::sin(angle), 0., -std::cos(angle)));
  const double exact = std::numbers::pi * std::sqrt(length / gravity) *
                       (1. + angle * angle / 16.);
  const double dt = 2e-5;
  double turned = 0.;
  for (double before = -1.; turned == 0. && engine.time() < 2.;)
  {
    engine.advance(dt);
    const double now = engine.particles().velocity(0).x();
    if (before < 0. && now >= 0.)
      turned = engine.time() - dt * now / (now - before);
    before = now;
  }
  // A turning point is found to 1e-3 of the period: bounces on the spring.
  EXPECT_NEAR(turned / exact, 1., 2e-3);
}

// A ball on the bottom of a turning drum slides until it rolls: it is carried
// at mu g, and spun up at 5 mu g / (2 r).
TEST(EngineDrum, FrictionCarriesABallAlong)
{
  dem::EngineParameters p = drum_parameters();
  p.wall.friction = 0.3;
  p.wall.normal_damping = p.wall.shear_damping = 0.2;
  dem::Engine engine(p);
  dem::Drum drum = plain_drum();
  drum.spin = 3.; // wall 0.9 m/s
  dem::set_drum(engine, drum);
  const double r = 0.02;
  const double mass =
      p.particle.density * 4. / 3. * std::numbers::pi * std::pow(r, 3);
  const double sag = mass * gravity / p.wall.normal_stiffness;
  support::add_sphere(engine, r, {0., 0., -(drum.radius - r + sag)});
  support::advance(engine, 1e-5, 2000);
  const double time = engine.time();
  // About +y the bottom, at -z, goes to -x.
  const double carried = -engine.particles().velocity(0).x();
  // Up the wall gravity takes (g / (R - r)) (mu g t^3 / 6), 2.3e-3 of it here;
  // the shear spring takes some steps to slide.
  EXPECT_NEAR(carried / (p.wall.friction * gravity * time), 1., 5e-3);
  EXPECT_NEAR(std::abs(engine.particles().spin(0).y()) /
                  (2.5 * p.wall.friction * gravity / r * time),
              1., 5e-3);
  // The moment of the friction on the drum, against its turning.
  EXPECT_NEAR(dem::drum(engine).torque /
                  (-p.wall.friction * mass * gravity * drum.radius),
              1., 1e-2);
}

// The lifter lifts balls and drops them: what the drum puts in, gravity and the
// losses take out. Velocity Verlet leaves the square of the step.
TEST(EngineDrum, EnergyIsAccountedForThroughATurn)
{
  dem::EngineParameters p = drum_parameters();
  p.wall.friction = p.particle.friction = 0.4;
  p.wall.normal_damping = p.wall.shear_damping = 0.3;
  p.particle.normal_damping = p.particle.shear_damping = 0.3;
  p.particle.shear_modulus = 1e7;
  p.other_solids = {{7850., 2e7, 0.3}};
  dem::Engine engine(p);
  dem::Drum drum = plain_drum();
  drum.spin = 3.3;
  drum.lifter_height = 0.09;
  drum.lifter_thickness = 0.02;
  dem::set_drum(engine, drum);
  for (int k = 0; k < 6; ++k)
    engine.add_particle(dem::make_sphere(0.015 + 0.002 * k),
                        {0.05 * (k - 2.5), 0.02 * (k % 3), -0.1},
                        dem::Quaternion::Identity(),
                        static_cast<std::uint8_t>(k % 2));
  const double end = 2. * std::numbers::pi / drum.spin;
  double highest = -1.;
  while (engine.time() < end)
  {
    engine.advance(2e-5);
    for (std::size_t i = 0; i < 6; ++i)
    {
      const dem::Vec3 &x = engine.particles().position(i);
      highest = std::max(highest, x.z());
      ASSERT_LT(std::hypot(x.x(), x.z()), drum.radius);
      ASSERT_LT(std::abs(x.y()), 0.5 * drum.length);
    }
  }
  EXPECT_GT(highest, 0.1); // the lifter has lifted one
  EXPECT_NEAR(dem::drum(engine).angle, drum.spin * engine.time(), 1e-9);
  EXPECT_GT(engine.energy().work_of("drum"), 0.1);
  EXPECT_LT(std::abs(energy_residual(engine)),
            1e-3 * engine.energy().work_of("drum"));
}

TEST(EngineDrum, NearestPoints)
{
  dem::Drum drum = plain_drum();
  drum.lifter_height = 0.09;
  drum.lifter_thickness = 0.02;
  const dem::Vec3 x(0.05, 0.1, 0.1);
  const dem::DrumPoint wall = nearest_on_drum(drum, dem::DrumPart::cylinder, x);
  EXPECT_NEAR(wall.distance, 0.3 - std::hypot(0.05, 0.1), 1e-15);
  EXPECT_NEAR(wall.point.y(), 0.1, 1e-15);
  EXPECT_NEAR(nearest_on_drum(drum, dem::DrumPart::upper_end, x).distance, 0.1,
              1e-15);
  EXPECT_NEAR(nearest_on_drum(drum, dem::DrumPart::lower_end, x).distance, 0.3,
              1e-15);
  // The lifter points up from z = 0.21, x = -0.01 .. 0.01: nearest is an edge.
  const dem::DrumPoint lifter = nearest_on_drum(drum, dem::DrumPart::lifter, x);
  EXPECT_NEAR(lifter.distance, std::hypot(0.04, 0.11), 1e-15);
  EXPECT_LT((lifter.point - dem::Vec3(0.01, 0.1, 0.21)).norm(), 1e-15);
  drum.angle = 0.5 * std::numbers::pi; // now along y x z = x
  const dem::DrumPoint turned =
      nearest_on_drum(drum, dem::DrumPart::lifter, dem::Vec3(0.1, 0., 0.005));
  EXPECT_NEAR(turned.distance, 0.11, 1e-15);
  EXPECT_LT((turned.normal - dem::Vec3::UnitX()).norm(), 1e-12);
}
