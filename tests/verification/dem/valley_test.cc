#include "dem_scene.h"

#include <dem/engine_boundaries.h>

#include <gtest/gtest.h>

#include <cmath>

// A ball in a valley of one surface, which several of its facets carry.
namespace
{
constexpr double equivalent_radius = 0.01, gravity = 9.81;

/// A valley along y in one surface, its sides turned by `half` from the plane.
dem::FacetSurface groove(double half)
{
  std::vector<dem::Vec3> position;
  for (const double y : {-0.05, 0.05})
    for (const double x : {-0.05, 0., 0.05})
      position.emplace_back(x, y, std::tan(half) * std::abs(x));
  return support::fixed_surface(position,
                                {{0, 3, 1}, {1, 3, 4}, {1, 4, 2}, {2, 4, 5}});
}

dem::EngineParameters springs_only()
{
  dem::EngineParameters p = support::bare_parameters();
  p.surface.normal_stiffness = 2e5;
  return p;
}

/// Energy lost by a ball and a valley of loose vertices that it has fallen into
/// and left again, as a part of what it had.
double lost_between(double steps_per_unit)
{
  dem::Engine engine(springs_only());
  const double half = 0.25;
  support::add_sphere(engine, equivalent_radius,
                      {2e-4, 1e-3, equivalent_radius / std::cos(half) + 1e-4});
  engine.particles().velocity(0) = {0., 0., -0.2};
  dem::FacetSurface valley = groove(half);
  const double mass = 3. * engine.particles().mass(0);
  valley.mass.assign(valley.position.size(), mass);
  dem::attach_surface(engine, std::move(valley));
  const auto energy = [&]
  {
    double sum = 0.5 * engine.particles().mass(0) *
                 engine.particles().velocity(0).squaredNorm();
    for (const dem::Vec3 &v : dem::surface(engine).velocity)
      sum += 0.5 * mass * v.squaredNorm();
    return sum;
  };
  const double start = energy();
  const double dt =
      std::sqrt(engine.particles().mass(0) / 2e5) / steps_per_unit;
  const int n = static_cast<int>(16. * steps_per_unit);
  for (int step = 0; step < n; ++step)
  {
    dem::FacetSurface &surface = dem::surface(engine);
    for (std::size_t v = 0; v < surface.position.size(); ++v)
    {
      surface.velocity[v] += 0.5 * dt / mass * surface.load[v];
      surface.position[v] += dt * surface.velocity[v];
    }
    engine.advance(dt);
    for (std::size_t v = 0; v < surface.position.size(); ++v)
      surface.velocity[v] += 0.5 * dt / mass * surface.load[v];
  }
  EXPECT_GT(engine.particles().velocity(0).z(), 0.05);
  EXPECT_EQ(support::only_nearest_point(dem::on_facets(engine)),
            dem::on_facets(engine).size());
  return std::abs(energy() / start - 1.);
}
} // namespace

// Particle and vertices hand each other what they have: the forces of a contact
// that two facets carry are those of one energy of all.
TEST(EngineFacets, NoEnergyIsLostBetweenBallAndValley)
{
  const double coarse = lost_between(50.), fine = lost_between(200.);
  EXPECT_LT(coarse, 1e-4);
  EXPECT_LT(fine, 1e-5);
}

// To and fro in a valley without damping: over a hundred swings across its
// line it never comes higher than where it began.
TEST(EngineFacets, BallSwingsInAValley)
{
  dem::EngineParameters p = springs_only();
  p.gravity = {0., 0., -gravity};
  const double half = 0.25;
  dem::Engine engine(p);
  support::add_sphere(engine, equivalent_radius,
                      {1e-4, 0., equivalent_radius / std::cos(half) + 3e-5});
  dem::attach_surface(engine, groove(half));
  const double dt =
      0.05 * std::sqrt(engine.particles().mass(0) / p.surface.normal_stiffness);
  double highest = 0.;
  int n_crossings = 0;
  double side = 1.;
  const double top = engine.particles().position(0).z();
  for (int step = 0; step < 200000; ++step)
  {
    engine.advance(dt);
    const dem::Vec3 &x = engine.particles().position(0);
    highest = std::max(highest, x.z() - top);
    n_crossings += x.x() * side < 0.;
    side = x.x() < 0. ? -1. : 1.;
  }
  EXPECT_GT(n_crossings, 150);
  EXPECT_LT(highest, 1e-7);
}
