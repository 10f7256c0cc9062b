#include "dem_scene.h"

#include <dem/engine_boundaries.h>

#include <gtest/gtest.h>

// A sphere of 1 mm rebounds in a box of 50 mm made of 1200 triangles as it does
// between six planes.
namespace
{
using dem::Vec3;

constexpr double side = 0.05, radius = 1e-3, speed = 0.6106, restitution = 0.5;
constexpr int n_cells = 10; // per edge: 2 x 100 triangles per face

/// Damping ratio of a linear contact without tension with this restitution
/// (docs/theory/contact.md), by bisection.
double damping_of(double wanted)
{
  double low = 0., high = 0.99;
  for (int k = 0; k < 100; ++k)
  {
    const double z = 0.5 * (low + high), root = std::sqrt(1. - z * z);
    const double e =
        std::exp(-z / root * std::atan2(2. * z * root, 2. * z * z - 1.));
    (e > wanted ? low : high) = z;
  }
  return low;
}

/// The inside of the cube, each face with its own vertices: edges are rims.
dem::FacetSurface box_of_triangles()
{
  std::vector<Vec3> position;
  std::vector<std::array<std::int32_t, 3>> triangles;
  for (int d = 0; d < 3; ++d)
    for (const double end : {0., side})
    {
      const auto first = static_cast<std::int32_t>(position.size());
      for (int i = 0; i <= n_cells; ++i)
        for (int j = 0; j <= n_cells; ++j)
        {
          Vec3 x;
          x[d] = end;
          x[(d + 1) % 3] = side * i / n_cells;
          x[(d + 2) % 3] = side * j / n_cells;
          position.push_back(x);
        }
      for (std::int32_t i = 0; i < n_cells; ++i)
        for (std::int32_t j = 0; j < n_cells; ++j)
        {
          const std::int32_t a = first + i * (n_cells + 1) + j,
                             b = a + n_cells + 1;
          const bool is_upper = end > 0.; // counter-clockwise from outside
          for (const auto &t : {std::array{a, b, b + 1}, {a, b + 1, a + 1}})
            triangles.push_back(is_upper ? t : std::array{t[0], t[2], t[1]});
        }
    }
  return support::fixed_surface(position, triangles);
}

dem::EngineParameters box_parameters()
{
  dem::EngineParameters p = support::bare_parameters();
  p.wall.normal_stiffness = 2e4;
  p.wall.shear_stiffness = 1.7e4;
  p.wall.friction = 0.3;
  p.wall.normal_damping = p.wall.shear_damping = damping_of(restitution);
  p.surface = p.wall;
  return p;
}

void add_ball(dem::Engine &engine)
{
  support::add_sphere(engine, radius, {0.021, 0.017, 0.024});
  engine.particles().velocity(0) = speed * Vec3(0.75, -0.5, 0.43).normalized();
}
} // namespace

TEST(EngineBox, TrianglesReboundAsPlanes)
{
  dem::Engine planes(box_parameters()), triangles(box_parameters());
  add_ball(planes);
  add_ball(triangles);
  for (int d = 0; d < 3; ++d)
  {
    dem::add_plane(planes, Vec3::Zero(), Vec3::Unit(d));
    dem::add_plane(planes, side * Vec3::Unit(d), -Vec3::Unit(d));
  }
  const dem::FacetSurface box = box_of_triangles();
  ASSERT_EQ(box.triangles.size(), 1200u);
  dem::attach_surface(triangles, box);
  constexpr double dt = 4e-6;
  int n_impacts = 0;
  bool was_touching = false;
  double apart = 0.;
  for (int step = 0; step < 110000; ++step)
  {
    planes.advance(dt);
    triangles.advance(dt);
    apart = std::max(apart, (planes.particles().position(0) -
                             triangles.particles().position(0))
                                .norm());
    const auto &on_planes = dem::on_planes(planes);
    bool is_touching = false;
    for (std::size_t k = 0; k < on_planes.size(); ++k)
      is_touching |= on_planes.is_touching(k);
    n_impacts += is_touching && !was_touching;
    was_touching = is_touching;
  }
  EXPECT_GE(n_impacts, 5);
  // Round-off of the normals, which impacts carry on.
  EXPECT_LT(apart, 1e-12);
  EXPECT_LT(planes.particles().velocity(0).norm(), 0.6 * speed);
}

// Straight on a face, an edge between two triangles, a vertex.
TEST(EngineBox, RestitutionIsThatOfTheLaw)
{
  const double cell = side / n_cells;
  for (const Vec3 &at :
       {Vec3(0., 2.3 * cell, 4.6 * cell), Vec3(0., 2.5 * cell, 4.5 * cell),
        Vec3(0., 5. * cell, 4. * cell)})
  {
    dem::Engine engine(box_parameters());
    support::add_sphere(engine, radius, at + Vec3(2. * radius, 0., 0.));
    engine.particles().velocity(0).x() = -speed;
    dem::attach_surface(engine, box_of_triangles());
    support::advance(engine, 1e-6, 10000);
    // One step of some 150 in the impact: dashpots are half a step late.
    EXPECT_NEAR(engine.particles().velocity(0).x() / speed, restitution, 4e-3);
    EXPECT_LT(engine.particles().velocity(0).tail<2>().norm(), 1e-9 * speed);
  }
}
