#include "dem_scene.h"

#include <dem/engine_boundaries.h>
#include <dem/integrate/time_step.h>

#include <gtest/gtest.h>

// The stated critical step of one ball on a wall is the true one: a small
// disturbance of the resting ball stays small 0.4 % below it and grows without
// bound 0.4 % above it. A factor of 3.5 wrong by 1 % is caught.
namespace
{
constexpr double equivalent_radius = 0.01, gravity = 1e4;

dem::EngineParameters wall_parameters()
{
  dem::EngineParameters p = support::bare_parameters();
  p.particle.shear_modulus = 1e5; // the Rayleigh step is far longer
  p.wall.normal_stiffness = 1e8;
  p.wall.shear_stiffness = 0.;
  p.wall.friction = 1e6;
  p.gravity = {0., 0., -gravity};
  return p;
}

/// A ball that the weight presses onto the plane z = 0.
dem::Engine pressed_sphere(const dem::EngineParameters &parameters)
{
  dem::Engine engine(parameters);
  dem::add_plane(engine, dem::Vec3::Zero(), dem::Vec3::UnitZ());
  support::add_sphere(engine, equivalent_radius, {0., 0., equivalent_radius});
  engine.particles().position(0).z() -=
      engine.particles().mass(0) * gravity / parameters.wall.normal_stiffness;
  return engine;
}

/// Speeds of the ball after many steps of `share` of the critical step over
/// what they were soon after the disturbance.
double growth(const dem::EngineParameters &parameters, double share)
{
  dem::Engine engine = pressed_sphere(parameters);
  const dem::StepLimit limit =
      dem::critical_step(parameters, engine.particles());
  EXPECT_NE(limit.reason.find("wall"), std::string::npos);
  const double dt = share * limit.step;
  // At rest before the first step.
  engine.particles().load[0].force =
      -engine.particles().mass(0) * engine.parameters().gravity;
  engine.particles().velocity(0) = {1e-8, 0., 1e-8};
  const auto largest = [&](int n)
  {
    double speed = 0.;
    for (int step = 0; step < n; ++step)
    {
      engine.advance(dt);
      speed = std::max(speed, engine.particles().velocity(0).norm() +
                                  equivalent_radius *
                                      engine.particles().spin(0).norm());
    }
    return speed;
  };
  const double early = largest(10);
  support::advance(engine, dt, 2000);
  return largest(100) / early;
}

void expect_sharp(dem::EngineParameters parameters)
{
  parameters.surface = parameters.wall; // counts, though it is not there
  // Without damping it beats, up to 1 / sqrt(2 x 0.004) = 11 times.
  EXPECT_LT(growth(parameters, 0.996), 15.);
  EXPECT_GT(growth(parameters, 1.004), 100.);
}
} // namespace

TEST(EngineStep, NormalMode)
{
  for (const double beta : {0., 0.62})
  {
    dem::EngineParameters p = wall_parameters();
    p.wall.normal_damping = beta;
    expect_sharp(p);
  }
}

// The ball slides and turns: 1/m + r^2/I = 3.5/m.
TEST(EngineStep, ShearMode)
{
  for (const double beta : {0., 0.62})
  {
    dem::EngineParameters p = wall_parameters();
    p.wall.shear_stiffness = 0.85e8;
    p.wall.shear_damping = beta;
    expect_sharp(p);
  }
}

// The rolling spring k_s r^2 stiffens that mode: 3 + sqrt(6.5) undamped.
TEST(EngineStep, RollingMode)
{
  for (const double beta : {0., 0.2, 0.62})
  {
    dem::EngineParameters p = wall_parameters();
    p.wall.shear_stiffness = 0.85e8;
    p.wall.shear_damping = beta;
    p.wall.rolling_friction = 1e6;
    expect_sharp(p);
  }
}

// A ball of steel among particles is stiffer by far; its wave sets the step.
TEST(EngineStep, RayleighWaveOfEveryMaterial)
{
  dem::EngineParameters p = support::bare_parameters();
  p.wall.normal_stiffness = p.surface.normal_stiffness = 1.;
  p.wall.shear_stiffness = p.surface.shear_stiffness = 1.;
  p.other_solids = {{7850., 8e10, 0.3}};
  const auto rayleigh = [](double r, double rho, double G, double nu)
  { return M_PI * r * std::sqrt(rho / G) / (0.1631 * nu + 0.8766); };
  dem::Engine engine(p);
  support::add_sphere(engine, equivalent_radius, {0., 0., 0.});
  const double particle =
      rayleigh(equivalent_radius, p.particle.density, p.particle.shear_modulus,
               p.particle.poisson_ratio);
  EXPECT_NEAR(dem::critical_step(p, engine.particles()).step, particle,
              1e-12 * particle);
  engine.add_particle(dem::make_sphere(2. * equivalent_radius),
                      {0., 0., 4. * equivalent_radius},
                      dem::Quaternion::Identity(), 1);
  const dem::StepLimit limit = dem::critical_step(p, engine.particles());
  const double steel = rayleigh(2. * equivalent_radius, 7850., 8e10, 0.3);
  EXPECT_NEAR(limit.step, steel, 1e-12 * steel);
  EXPECT_NE(limit.reason.find("no particle"), std::string::npos);
}

// The membrane's contact counts as the walls do.
TEST(EngineStep, SurfaceCountsToo)
{
  dem::EngineParameters p = wall_parameters();
  p.surface = p.wall;
  dem::Engine engine = pressed_sphere(p);
  const double wall = dem::critical_step(p, engine.particles()).step;
  p.surface.normal_stiffness = 4. * p.wall.normal_stiffness;
  const dem::StepLimit limit = dem::critical_step(p, engine.particles());
  EXPECT_NEAR(limit.step, 0.5 * wall, 1e-12 * wall);
  EXPECT_NE(limit.reason.find("membrane"), std::string::npos);
}
