#include "coupled_scene.h"

#include <gtest/gtest.h>

// A sphere on an inclined wall that moves along itself: closed forms of sliding
// and rolling, with the velocity of the wall between its positions.
namespace
{
constexpr double radius = 0.01, gravity = 9.81, friction = 0.2, stiffness = 1e5;

struct Slide
{
  double angle = 0.; ///< of the incline [rad]
  double speed = 0.; ///< of the wall, uphill [m/s]
  int particle_steps = 1;
  coupling::ExchangeRule rule = coupling::ExchangeRule::one_pass;
};

struct Course
{
  double speed = 0.;         ///< of the sphere, uphill [m/s]
  double turning = 0.;       ///< R omega, positive where it rolls uphill [m/s]
  double work_residual = 0.; ///< of the ledger [-]
};

/// Gravity is tilted, the wall is z = 0; uphill is +x.
Course run(const Slide &slide, double duration)
{
  dem::EngineParameters p = support::bare_parameters();
  p.surface.normal_stiffness = stiffness;
  p.surface.shear_stiffness = 0.85 * stiffness;
  p.surface.friction = friction;
  p.surface.normal_damping = p.surface.shear_damping = 0.5;
  p.gravity =
      gravity * dem::Vec3(-std::sin(slide.angle), 0., -std::cos(slide.angle));
  dem::Engine engine(p);
  support::add_sphere(engine, radius, {0., 0., radius});
  const double mass = engine.particles().mass(0);
  // At rest in the wall from the start.
  engine.particles().position(0).z() -=
      mass * gravity * std::cos(slide.angle) / stiffness;

  coupling::ExchangeParameters rules;
  rules.rule = slide.rule;
  rules.particle_steps = slide.particle_steps;
  coupling::Exchange exchange(rules);
  const fem::SurfaceMesh wall = support::square_at(2., 0., 4);
  fem::PlateBodyParameters held = support::upright(1.);
  held.moves = {false, false, false};
  coupling::RigidDrive drive;
  drive.path = [&slide](double time)
  { return dem::Vec3(slide.speed * time, 0., 0.); };
  exchange.add(std::make_unique<coupling::RigidBody>(held, wall.nodes, drive),
               wall, "wall", p.surface, coupling::ParticleSide::outside,
               engine);
  const double step = 0.1 * std::sqrt(mass / stiffness);
  const auto n = std::lround(duration / (step * slide.particle_steps));
  const auto particles = coupling::particles_of(engine, support::no_shapes());
  for (long k = 0; k < n; ++k)
    exchange.advance(particles, duration / double(n));
  return {engine.particles().velocity(0).x(),
          radius * engine.particles().spin(0).y(),
          exchange.ledger().work_residual()};
}

const coupling::ExchangeRule rules_of_walls[] = {
    coupling::ExchangeRule::every_step, coupling::ExchangeRule::one_pass,
    coupling::ExchangeRule::iterated};
} // namespace

// tan(angle) < 7 f / 2: rolls down with 5/7 g sin(angle); beyond it slides with
// g (sin - f cos) and turns with 5/2 g f cos.
TEST(MovingWall, RollsOrSlidesDownTheIncline)
{
  const double time = 0.1;
  for (const int n : {1, 10})
  {
    const double gentle = 0.3, steep = 1.;
    const Course rolls = run({gentle, 0., n}, time);
    EXPECT_NEAR(rolls.speed, -5. / 7. * gravity * std::sin(gentle) * time,
                2e-3 * std::abs(rolls.speed));
    EXPECT_NEAR(rolls.turning, rolls.speed, 2e-3 * std::abs(rolls.speed));
    const Course slides = run({steep, 0., n}, time);
    EXPECT_NEAR(slides.speed,
                -gravity * (std::sin(steep) - friction * std::cos(steep)) *
                    time,
                2e-3 * std::abs(slides.speed));
    EXPECT_NEAR(slides.turning,
                -2.5 * gravity * friction * std::cos(steep) * time,
                3e-3 * std::abs(slides.turning));
  }
}

// A wall with speed V drags a sphere at rest: f g until v = V - R omega' meets
// it at t = 2 V / (7 f g), from then on v = 2 V / 7. On an incline the same
// with gravity besides, for as long as it slides: the wall's velocity is what
// counts.
TEST(MovingWall, DragsTheSphereAlong)
{
  const double speed = 0.5;
  const double slip = 2. * speed / (7. * friction * gravity);
  for (const auto rule : rules_of_walls)
    for (const int n : {1, 10})
    {
      if (rule == coupling::ExchangeRule::every_step && n > 1)
        continue;
      const Course half = run({0., speed, n, rule}, 0.5 * slip);
      EXPECT_NEAR(half.speed, 0.5 * friction * gravity * slip,
                  3e-3 * half.speed);
      const Course later = run({0., speed, n, rule}, 1.5 * slip);
      EXPECT_NEAR(later.speed, 2. / 7. * speed, 3e-3 * speed);
      EXPECT_NEAR(later.speed - later.turning, speed, 3e-3 * speed);
      const double angle = 0.4, time = 0.03;
      const Course uphill = run({angle, 2. * speed, n, rule}, time);
      EXPECT_NEAR(uphill.speed,
                  gravity * (friction * std::cos(angle) - std::sin(angle)) *
                      time,
                  3e-3 * std::abs(uphill.speed));
      // A wall that is moved leaves no doubt about its motion.
      for (const Course &course : {half, later, uphill})
        EXPECT_LT(course.work_residual, 1e-11);
    }
}
