#include "dem_scene.h"
#include "wall_meshes.h"

#include <dem/boundary/surface_guard.h>
#include <dem/engine_boundaries.h>

#include <gtest/gtest.h>

using dem::SurfaceFlaw;
using dem::Vec3;

namespace
{
/// Two triangles on the x axis; the second is turned up from the flat by this.
dem::FacetSurface hinge(double degrees)
{
  const double angle = degrees * M_PI / 180.;
  return support::fixed_surface({{0., 0., 0.},
                                 {1., 0., 0.},
                                 {0.5, 1., 0.},
                                 {0.5, -std::cos(angle), std::sin(angle)}},
                                {{0, 1, 2}, {1, 0, 3}});
}

std::optional<dem::SurfaceFault> fold_of(const dem::FacetSurface &surface)
{
  const dem::FacetTopology topology(surface);
  return dem::find_fold({surface, topology});
}

std::optional<dem::SurfaceFault> crossing_of(const dem::FacetSurface &surface)
{
  const dem::FacetTopology topology(surface);
  return dem::find_crossing({surface, topology});
}

/// A band of squares along an arc of this angle and radius 1 that climbs by
/// `lift` across its own start.
dem::FacetSurface spiral(double degrees, double lift)
{
  const int n = 40;
  std::vector<Vec3> position;
  std::vector<std::array<std::int32_t, 3>> triangles;
  for (int k = 0; k <= n; ++k)
    for (const double y : {-0.3, 0.3})
    {
      const double s = double(k) / n, phi = degrees * M_PI / 180. * s;
      position.emplace_back((1. + lift * (s - 0.5)) * std::cos(phi), y,
                            (1. + lift * (s - 0.5)) * std::sin(phi));
    }
  for (std::int32_t k = 0; k < n; ++k)
  {
    triangles.push_back({2 * k, 2 * k + 1, 2 * k + 2});
    triangles.push_back({2 * k + 1, 2 * k + 3, 2 * k + 2});
  }
  return support::fixed_surface(position, triangles);
}

/// A sphere of 10 mm about here in a cube of 100 mm, lists made.
std::optional<dem::SurfaceFault> left_of(const Vec3 &centre)
{
  dem::Engine engine(support::deep_parameters());
  support::add_sphere(engine, 0.01, centre);
  dem::attach_surface(engine, support::box_inside(0.1));
  engine.advance(1e-12);
  return dem::find_left(dem::facet_boundary(engine, 0), engine.particles(),
                        dem::ContactGeometry::radial);
}
} // namespace

TEST(SurfaceGuard, FoldIsFoundBeyond150Degrees)
{
  for (const double degrees : {-149., -90., 0., 45., 149.})
    EXPECT_FALSE(fold_of(hinge(degrees))) << degrees;
  for (const double degrees : {-179., -151., 151., 179.})
  {
    const auto fault = fold_of(hinge(degrees));
    ASSERT_TRUE(fault) << degrees;
    EXPECT_EQ(fault->first, 0);
    EXPECT_EQ(fault->second, 1);
    EXPECT_LT((fault->position - Vec3(0.5, 0., 0.)).norm(), 1e-14);
  }
}

// A square of four triangles whose centre leaves it in its plane.
TEST(SurfaceGuard, InvertedFacetIsAFold)
{
  dem::FacetSurface fan = support::coplanar_fan(4, 1., 0.3);
  fan.position[4] = {0.6, 0., 0.};
  EXPECT_FALSE(fold_of(fan));
  fan.position[4] = {0.8, 0.5, 0.};
  ASSERT_TRUE(fold_of(fan));
  EXPECT_EQ(fold_of(fan)->flaw, SurfaceFlaw::folded);
}

TEST(SurfaceGuard, CrossingIsFound)
{
  EXPECT_FALSE(crossing_of(spiral(340., 0.2)));
  EXPECT_FALSE(crossing_of(spiral(400., 0.2))); // lies above itself
  dem::FacetSurface shifted = spiral(400., 0.2);
  for (std::size_t k = 0; k < 10; ++k) // its start goes out through its end
    shifted.position[k] *= 1. + 0.05 * double(9 - k);
  const auto fault = crossing_of(shifted);
  ASSERT_TRUE(fault);
  EXPECT_EQ(fault->flaw, SurfaceFlaw::crossed);
  EXPECT_FALSE(crossing_of(support::flat_floor(1., 12, 0.)));
  EXPECT_FALSE(crossing_of(support::flat_floor(1., 12, 0.4)));
  EXPECT_FALSE(crossing_of(support::box_inside(1.)));
}

// Every pair of facets against every edge, on floors so rough that they cross.
TEST(SurfaceGuard, CrossingAgreesWithBruteForce)
{
  int n_crossed = 0;
  for (unsigned seed = 1; seed <= 60; ++seed)
  {
    dem::FacetSurface floor = support::flat_floor(1., 6, 0.8, seed);
    std::mt19937 generator(seed);
    std::uniform_real_distribution<double> some(-1., 1.);
    for (Vec3 &x : floor.position)
      x += 0.5 * Vec3(some(generator), some(generator), 0.);
    bool is_crossed = false;
    const auto n = std::int32_t(floor.triangles.size());
    for (std::int32_t a = 0; a < n; ++a)
      for (std::int32_t b = 0; b < n; ++b)
      {
        const auto &va = floor.triangles[std::size_t(a)],
                   &vb = floor.triangles[std::size_t(b)];
        bool has_common = false;
        for (const auto v : va)
          for (const auto w : vb)
            has_common |= v == w;
        const auto t = dem::corners_of(floor, a), s = dem::corners_of(floor, b);
        for (std::size_t c = 0; c < 3 && !has_common; ++c)
        {
          Eigen::Matrix3d m; // t0 + u e1 + v e2 = s_c + w d
          m << t[1] - t[0], t[2] - t[0], s[c] - s[(c + 1) % 3];
          const Vec3 uvw = m.inverse() * (s[c] - t[0]);
          is_crossed |=
              uvw.minCoeff() > 0. && uvw.z() < 1. && uvw.x() + uvw.y() < 1.;
        }
      }
    n_crossed += is_crossed;
    EXPECT_EQ(bool(crossing_of(floor)), is_crossed) << seed;
  }
  EXPECT_GT(n_crossed, 5);
  EXPECT_LT(n_crossed, 55);
}

TEST(SurfaceGuard, ParticleIsOutsideWithItsCentre)
{
  for (const Vec3 &inside :
       {Vec3(0.05, 0.05, 0.05), Vec3(0.05, 0.05, 0.001),
        Vec3(0.001, 0.001, 0.05), Vec3(0.099, 0.099, 0.099)})
    EXPECT_FALSE(left_of(inside)) << inside.transpose();
  // Through a face, an edge, a corner.
  for (const Vec3 &outside :
       {Vec3(0.05, 0.04, -0.001), Vec3(-0.002, -0.001, 0.05),
        Vec3(0.101, 0.102, 0.101), Vec3(0.05, 0.108, 0.05)})
  {
    const auto fault = left_of(outside);
    ASSERT_TRUE(fault) << outside.transpose();
    EXPECT_EQ(fault->flaw, SurfaceFlaw::left);
    EXPECT_EQ(fault->second, 0);
  }
}

// Beside an open floor there is no outside.
TEST(SurfaceGuard, RimLetsParticlesPass)
{
  for (const double z : {0.005, -0.003})
  {
    dem::Engine engine(support::deep_parameters());
    support::add_sphere(engine, 0.01, {0.053, 0.01, z});
    dem::FacetSurface floor =
        support::coplanar_fan(4, 0.05 * std::sqrt(2.), M_PI / 4.);
    dem::attach_surface(engine, floor);
    engine.advance(1e-12);
    EXPECT_FALSE(dem::find_left(dem::facet_boundary(engine, 0),
                                engine.particles(),
                                dem::ContactGeometry::radial));
  }
}
