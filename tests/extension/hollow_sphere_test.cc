#include "hollow_sphere.h"

#include <gtest/gtest.h>

#include <dem_scene.h>
#include <sstream>

namespace
{
constexpr double bowl = 0.1, radius = 5e-3;

dem::EngineParameters bowl_parameters()
{
  dem::EngineParameters p = support::bare_parameters();
  p.wall.normal_stiffness = 1e6;
  p.gravity = {0., 0., -9.81};
  return p;
}

dem::Engine scene()
{
  const dem::EngineParameters p = bowl_parameters();
  dem::Engine engine(p);
  engine.add_boundary(std::make_unique<HollowSphere>(p.wall, bowl));
  return engine;
}
} // namespace

// Without friction a sphere swings as a pendulum of the length R - r: the
// period 2 pi sqrt(l / g) (1 + phi^2 / 16) of a small amplitude phi.
TEST(HollowSphere, SphereSwingsAsAPendulum)
{
  dem::Engine engine = scene();
  const double length = bowl - radius, amplitude = 0.1;
  support::add_sphere(
      engine, radius,
      length * dem::Vec3(std::sin(amplitude), 0., -std::cos(amplitude)));
  const double energy = engine.energy().kinetic;
  std::vector<double> crossings;
  double before = 1.;
  while (crossings.size() < 3)
  {
    engine.advance(2e-6);
    const double x = engine.particles().position(0).x();
    if (before > 0. && x <= 0.)
      crossings.push_back(engine.time());
    before = x;
  }
  const double period = 2. * std::numbers::pi * std::sqrt(length / 9.81) *
                        (1. + amplitude * amplitude / 16.);
  EXPECT_NEAR(crossings[2] - crossings[1], period, 1e-3 * period);
  const dem::EngineEnergy now = engine.energy();
  EXPECT_NEAR(now.kinetic + now.elastic + now.non_conservative_work -
                  now.gravity_work,
              energy, 1e-3 * now.kinetic);
}

TEST(HollowSphere, BearsTheWeightOfWhatLiesInIt)
{
  dem::EngineParameters p = bowl_parameters();
  p.wall.normal_damping = p.particle.normal_damping = 0.5;
  p.local_damping = 0.3;
  dem::Engine engine(p);
  auto &wall = static_cast<HollowSphere &>(
      engine.add_boundary(std::make_unique<HollowSphere>(p.wall, bowl)));
  for (int k = 0; k < 5; ++k)
    support::add_sphere(engine, radius, {0.012 * k - 0.024, 0.001 * k, -0.08});
  support::advance(engine, 1e-5, 50000);
  const double weight = 5. * 9.81 * engine.particles().mass(0);
  EXPECT_NEAR(wall.force.z(), -weight, 0.01 * weight);
}

TEST(HollowSphere, IsRestartedByItsName)
{
  dem::add_boundary_kind(HollowSphere::kind_name,
                         std::make_unique<HollowSphere>);
  dem::Engine one = scene();
  support::add_sphere(one, radius, {0.03, 0., -0.0902});
  support::advance(one, 1e-5, 2000);
  std::stringstream file;
  one.save(file, {});
  dem::Engine other(bowl_parameters());
  other.restore(file, {});
  support::advance(one, 1e-5, 2000);
  support::advance(other, 1e-5, 2000);
  EXPECT_EQ(one.particles().position(0), other.particles().position(0));
}
