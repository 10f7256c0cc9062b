#include "dem_scene.h"
#include "reference_impacts.h"

#include <gtest/gtest.h>

// Impacts in the engine against the closed forms of reference_impacts.h.
namespace
{
// Chung & Ooi (2011), test 1.
const reference::SphereMaterial glass{2800., 48e9, 0.2};
constexpr double ball_radius = 0.01; // [m]

dem::EngineParameters glass_parameters()
{
  dem::EngineParameters p = support::bare_parameters();
  p.stone.density = glass.density;
  p.stone.shear_modulus = glass.shear_modulus();
  p.stone.poisson_ratio = glass.poisson_ratio;
  return p;
}

/// Two balls that touch and approach each other, each at `speed`.
dem::Engine two_balls(const dem::EngineParameters &parameters, double speed)
{
  dem::Engine engine(parameters);
  for (const double side : {-1., 1.})
  {
    support::add_sphere(engine, ball_radius,
                        side * ball_radius * dem::Vec3::UnitX());
    engine.particles().last().velocity = -side * speed * dem::Vec3::UnitX();
  }
  return engine;
}

/// From the positions alone [m].
double overlap_of(const dem::Engine &engine)
{
  const dem::Particles &balls = engine.particles();
  return 2. * ball_radius - (balls.position(1) - balls.position(0)).norm();
}

/// Runs an impact to separation.
reference::ImpactHistory run_impact(dem::Engine &engine, double time_step)
{
  reference::ImpactHistory history;
  double overlap = 0., before = 0.;
  do
  {
    before = overlap;
    engine.advance(time_step);
    overlap = overlap_of(engine);
    history.peak_overlap = std::max(history.peak_overlap, overlap);
    history.peak_force =
        std::max(history.peak_force, engine.particles().load[1].force.norm());
  } while (overlap > 0.);
  history.duration = engine.time() + time_step * overlap / (before - overlap);
  history.rebound_speed =
      (engine.particles().velocity(1) - engine.particles().velocity(0)).x();
  return history;
}

/// Rebound speed of a ball on a plane of the wall material over its speed.
double wall_restitution(double damping)
{
  dem::EngineParameters p = glass_parameters();
  p.wall.normal_damping = damping;
  dem::Engine engine(p);
  engine.add_plane(dem::Vec3::Zero(), dem::Vec3::UnitZ());
  support::add_sphere(engine, ball_radius, {0., 0., ball_radius});
  constexpr double speed = 0.1;
  engine.particles().velocity(0) = -speed * dem::Vec3::UnitZ();
  const double period =
      std::sqrt(engine.particles().mass(0) / p.wall.normal_stiffness);
  do
    engine.advance(1e-4 * period);
  while (engine.particles().position(0).z() < ball_radius);
  return engine.particles().velocity(0).z() / speed;
}
} // namespace

// 4000 steps an impact: the crest is missed by less than (pi / 4000)^2, the
// first step (no force yet) and the cut at the end cost less than one step:
// all below 3e-4. A modulus, density or radius wrong by 1 % moves one of the
// three by 0.4 % at least.
TEST(EngineImpact, TwoBallsAsHertz)
{
  const reference::HertzImpact exact =
      reference::equal_spheres(glass, ball_radius, 20.);
  dem::Engine engine = two_balls(glass_parameters(), 10.);
  const reference::ImpactHistory history =
      run_impact(engine, exact.duration() / 4000.);
  EXPECT_NEAR(history.peak_overlap / 274.1e-6, 1., 1e-3);
  EXPECT_NEAR(history.peak_force / 10.697e3, 1., 1e-3);
  EXPECT_NEAR(history.duration / 40.34e-6, 1., 1e-3);
  EXPECT_NEAR(history.peak_overlap / exact.peak_overlap(), 1., 3e-4);
  EXPECT_NEAR(history.peak_force / exact.peak_force(), 1., 3e-4);
  EXPECT_NEAR(history.duration / exact.duration(), 1., 3e-4);
  EXPECT_NEAR(history.rebound_speed, 20., 20. * 1e-5);
}

// The same stones as series of order 20: the shape path of the law.
TEST(EngineImpact, SeriesOfASphereIsASphere)
{
  auto series = std::make_shared<dem::Coefficients>(
      std::size_t(dem::n_coefficients(20)), 0.);
  series->front() = 1.;
  dem::Engine engine(glass_parameters());
  for (const double side : {-1., 1.})
  {
    engine.add_stone(dem::make_body(series, ball_radius),
                     side * ball_radius * dem::Vec3::UnitX(),
                     dem::Quaternion(0.5, 0.5, 0.5, 0.5));
    engine.particles().last().velocity = -side * 10. * dem::Vec3::UnitX();
  }
  const reference::HertzImpact exact =
      reference::equal_spheres(glass, ball_radius, 20.);
  const reference::ImpactHistory history =
      run_impact(engine, exact.duration() / 4000.);
  EXPECT_NEAR(history.peak_overlap / exact.peak_overlap(), 1., 3e-4);
  EXPECT_NEAR(history.peak_force / exact.peak_force(), 1., 3e-4);
  EXPECT_NEAR(history.duration / exact.duration(), 1., 3e-4);
}

// The dashpot is taken half a step late: first order in the step, below 5e-4
// at 1e-4 of the duration. A beta wrong by 1 % moves e by 0.0035.
TEST(EngineImpact, RestitutionOfTwoBalls)
{
  for (const double beta : {0.1, 0.27})
    for (const double speed : {0.05, 5.})
    {
      dem::EngineParameters p = glass_parameters();
      p.stone.normal_damping = beta;
      dem::Engine engine = two_balls(p, speed);
      const double duration =
          reference::equal_spheres(glass, ball_radius, 2. * speed).duration();
      const double e =
          run_impact(engine, 1e-4 * duration).rebound_speed / (2. * speed);
      EXPECT_NEAR(e, reference::hertz_restitution(beta), 5e-4) << beta;
      if (beta == 0.27)
      {
        EXPECT_NEAR(e, 0.455, 1e-3);
      }
      // Pushes come in pairs.
      const dem::Particles &balls = engine.particles();
      EXPECT_NEAR((balls.velocity(0) + balls.velocity(1)).norm(), 0.,
                  1e-12 * speed);
      // What is lost is booked: trapezoidal rule, second order.
      EXPECT_NEAR(engine.energy().damping,
                  (1. - e * e) * engine.particles().mass(0) * speed * speed,
                  1e-3 * engine.particles().mass(0) * speed * speed);
    }
}

// As above; a beta wrong by 1 % moves e by 0.0025.
TEST(EngineImpact, RestitutionOfTheLinearWall)
{
  EXPECT_NEAR(wall_restitution(0.62), 0.240, 1e-3);
  for (const double beta : {0., 0.2, 0.62})
    EXPECT_NEAR(wall_restitution(beta), reference::linear_restitution(beta),
                5e-4);
}

// Half a period pi sqrt(m / k), peak v sqrt(m / k); steps of 1e-3 of the unit
// of time: peak to 1e-6, duration to 1e-3 / pi by linear cut, much better.
TEST(EngineImpact, LinearWallStiffness)
{
  dem::EngineParameters p = glass_parameters();
  p.wall.normal_stiffness = 3e6;
  dem::Engine engine(p);
  engine.add_plane({0., 0., 0.5}, -dem::Vec3::UnitZ());
  support::add_sphere(engine, ball_radius, {0., 0., 0.5 - ball_radius});
  constexpr double speed = 0.2;
  engine.particles().velocity(0) = speed * dem::Vec3::UnitZ();
  const double unit =
      std::sqrt(reference::sphere_mass(glass.density, ball_radius) / 3e6);
  double peak = 0., overlap = 0., before = 0.;
  do
  {
    before = overlap;
    engine.advance(1e-3 * unit);
    overlap = engine.particles().position(0).z() + ball_radius - 0.5;
    peak = std::max(peak, overlap);
  } while (overlap > 0.);
  const double duration =
      engine.time() + 1e-3 * unit * overlap / (before - overlap);
  EXPECT_NEAR(peak, speed * unit, 1e-4 * speed * unit);
  EXPECT_NEAR(duration, std::numbers::pi * unit, 1e-3 * unit);
  EXPECT_NEAR(engine.planes()[0].force.norm(), 0., 0.);
}

// Two balls so heavy that they keep their motion, pressed together by delta,
// slide by s and turn by phi: shear spring 8 G* a s with a = sqrt(R* delta),
// 1/G* = 2 (2 - nu) / G, rolling spring k_s R^2 phi with R = r / 2, dashpot
// 2 beta sqrt(m* k_s) ds/dt. Balls turn the same way, so that they do not slide
// by turning.
TEST(EngineImpact, ShearAndRollingSprings)
{
  dem::EngineParameters p = glass_parameters();
  p.stone.density = 1e17;
  p.stone.friction = p.stone.rolling_friction = 10.;
  p.stone.shear_damping = 0.3;
  dem::Engine engine(p);
  constexpr double overlap = 1e-5, speed = 1e-4, spin = 2e-3, dt = 1e-6;
  constexpr int n_steps = 1000;
  for (const double side : {-1., 1.})
  {
    support::add_sphere(engine, ball_radius,
                        side * (ball_radius - 0.5 * overlap) *
                            dem::Vec3::UnitX());
    engine.particles().last().velocity.y() = side * 0.5 * speed;
    // Opposite spins about y: the contact points move alike along z.
    engine.particles().last().spin.y() = side * 0.5 * spin;
  }
  support::advance(engine, dt, n_steps);
  const double nu = glass.poisson_ratio;
  const double contact_radius = std::sqrt(0.5 * ball_radius * overlap);
  const double shear_stiffness =
      8. * glass.shear_modulus() / (2. * (2. - nu)) * contact_radius;
  const dem::ContactHistory<double> history = engine.pairs().history(0);
  const double time = n_steps * dt;
  // The branch turns by s / 2r = 5e-6.
  EXPECT_NEAR(history.shear.y / (shear_stiffness * speed * time), 1., 1e-4);
  EXPECT_NEAR(history.rolling.y / (shear_stiffness * 0.25 * ball_radius *
                                   ball_radius * spin * time),
              1., 1e-3);
  const double mass =
      0.5 * reference::sphere_mass(p.stone.density, ball_radius);
  EXPECT_NEAR(history.dashpot.y /
                  (0.6 * std::sqrt(mass * shear_stiffness) * speed),
              1., 1e-4);
}
