#include "wall_meshes.h"

#include <dem/boundary/wall_contact_points.h>
#include <dem/random.h>

#include <gtest/gtest.h>

#include <numeric>
#include <shape/test_shapes.h>

// Where particles meet walls, by what is known of spheres and ellipsoids.
namespace
{
using dem::Vec3;

struct Particle
{
  dem::ParticleShape body;
  dem::RadiusMap map;

  explicit Particle(dem::ParticleShape of)
      : body(std::move(of)), map(body.series)
  {
  }
  dem::MappedParticlePose
  at(const Vec3 &position,
     const dem::Quaternion &turned = dem::Quaternion::Identity()) const
  {
    return {{body, map}, position, turned.toRotationMatrix()};
  }
};

Particle ellipsoid(const Vec3 &axes)
{
  return Particle(dem::shape_of(
      dem::test::project(16, [&](const Vec3 &s)
                         { return dem::test::ellipsoid_radius(axes, s); })));
}

std::vector<std::int32_t> all_of(const support::WallMesh &mesh)
{
  std::vector<std::int32_t> all(mesh.surface.triangles.size());
  std::iota(all.begin(), all.end(), 0);
  return all;
}
} // namespace

// Of a sphere the deepest point of any mesh is the one next to its centre:
// faces, edges and vertices as they come.
TEST(WallContactPoints, OfASphereAreNextToItsCentre)
{
  const Particle sphere(dem::make_sphere(1.));
  dem::Random random(4);
  for (const auto &mesh :
       {support::flat_wall(1.2, 8, 0.35), support::stepped_wall(1.1, 8)})
  {
    const std::vector<std::int32_t> all = all_of(mesh);
    std::array<int, 3> met{};
    for (int k = 0; k < 800; ++k)
    {
      const Vec3 centre(4. * (random.uniform() - 0.5),
                        4. * (random.uniform() - 0.5),
                        0.9 + 0.9 * random.uniform());
      dem::NearestPoint nearest;
      double least = 1e9;
      for (const std::int32_t t : all)
      {
        const auto at =
            dem::nearest_point(centre, dem::corners_of(mesh.surface, t));
        if ((at.point - centre).norm() < least)
        {
          least = (at.point - centre).norm();
          nearest = at;
        }
      }
      if (least > 1.15 || least < 0.8)
        continue;
      const auto found =
          dem::find_on_facets(sphere.at(centre), mesh.view(), all, 0.2);
      ASSERT_FALSE(found.contact_points.empty()) << k;
      ++met[static_cast<std::size_t>(nearest.feature)];
      const dem::WallContactPoint &contact_point = found.contact_points.front();
      EXPECT_NEAR(contact_point.overlap, 1. - least, 1e-12) << k;
      EXPECT_LT((contact_point.point - nearest.point).norm(), 1e-7) << k;
      EXPECT_LT(
          (contact_point.normal - (nearest.point - centre) / least).norm(),
          1e-7);
    }
    EXPECT_GT(met[0], 20);          // faces
    EXPECT_GT(met[1] + met[2], 20); // edges and vertices
  }
}

// A face is met at the support point: an ellipsoid with the axes A reaches
// |A n| along n.
TEST(WallContactPoints, OfAnEllipsoidOnAFaceIsItsSupport)
{
  const Vec3 axes(1.2, 1., 0.8);
  const Particle particle = ellipsoid(axes);
  const support::WallMesh mesh = support::flat_wall(0.7, 8, 0.);
  const std::vector<std::int32_t> all = all_of(mesh);
  dem::Random random(7);
  for (int k = 0; k < 50; ++k)
  {
    const dem::Quaternion turned = random.rotation();
    const Vec3 down = turned.conjugate() * Vec3(-Vec3::UnitZ());
    const double height = axes.cwiseProduct(down).norm();
    const Vec3 foot = axes.cwiseProduct(axes).cwiseProduct(down) / height;
    const Vec3 centre(0.3 * random.uniform(), 0.2, height - 0.01);
    const auto found = dem::find_on_facets(particle.at(centre, turned),
                                           mesh.view(), all, 0.01);
    ASSERT_EQ(found.contact_points.size(), 1u) << k;
    // What the series leaves of the ellipsoid.
    EXPECT_NEAR(found.contact_points[0].overlap, 0.01, 1e-5);
    const Vec3 below = centre + turned * foot;
    EXPECT_LT(
        (found.contact_points[0].point - Vec3(below.x(), below.y(), 0.)).norm(),
        2e-3);
  }
}

// A vertex and an edge are met by their distance from the surface: above the
// pole of an ellipsoid of revolution, and beside its equator.
TEST(WallContactPoints, OfAnEllipsoidOnAVertexIsTheVertex)
{
  const Particle particle = ellipsoid({1., 1., 0.7});
  // A pyramid that stands up.
  dem::FacetSurface pyramid;
  pyramid.position = {{2., 2., -1.},
                      {-2., 2., -1.},
                      {-2., -2., -1.},
                      {2., -2., -1.},
                      {0., 0., 0.}};
  pyramid.triangles = {{1, 0, 4}, {2, 1, 4}, {3, 2, 4}, {0, 3, 4}};
  support::complete(pyramid);
  const support::WallMesh mesh(pyramid);
  const std::vector<std::int32_t> all = all_of(mesh);
  for (const double overlap : {-0.02, 0.001, 0.02})
  {
    const auto on_pole = dem::find_on_facets(
        particle.at({0., 0., 0.7 - overlap}), mesh.view(), all, 0.05);
    ASSERT_FALSE(on_pole.contact_points.empty());
    EXPECT_NEAR(on_pole.contact_points[0].overlap, overlap, 1e-5);
    EXPECT_LT(on_pole.contact_points[0].point.norm(), 1e-12);
    // Turned by 90 degrees the equator is below.
    const auto on_equator = dem::find_on_facets(
        particle.at({0., 0., 1. - overlap},
                    dem::Quaternion(Eigen::AngleAxisd(0.5 * std::numbers::pi,
                                                      Vec3::UnitX()))),
        mesh.view(), all, 0.05);
    ASSERT_FALSE(on_equator.contact_points.empty());
    EXPECT_NEAR(on_equator.contact_points[0].overlap, overlap, 1e-5);
  }
}

// In a hollow cylinder of the radius R a sphere off the axis by e is
// r + e - R deep; in a hollow as narrow as its end a long particle has two
// contact points.
TEST(WallContactPoints, OnACylinder)
{
  dem::Drum drum;
  drum.axis = Vec3::UnitZ();
  drum.radius = 2.;
  drum.length = 20.;
  const Particle sphere(dem::make_sphere(1.)),
      longish = ellipsoid({1.2, 0.8, 0.8});
  const auto found = dem::find_on_drum(sphere.at({0.6, 0.81, 0.}), drum,
                                       dem::DrumPart::cylinder, 0.1);
  ASSERT_EQ(found.contact_points.size(), 1u);
  EXPECT_NEAR(found.contact_points[0].overlap, 1. + std::hypot(0.6, 0.81) - 2.,
              1e-12);
  // Across the chord of its long axis both ends touch.
  drum.radius = 1.21;
  const auto ends = dem::find_on_drum(longish.at(Vec3::Zero()), drum,
                                      dem::DrumPart::cylinder, 0.1);
  ASSERT_EQ(ends.contact_points.size(), 2u);
  EXPECT_NEAR(ends.contact_points[0].overlap, -0.01, 1e-5);
  EXPECT_NEAR(ends.contact_points[1].overlap, -0.01, 1e-5);
}

// In a corner a particle meets each side, and each once.
TEST(WallContactPoints, EverySideOfACornerIsMet)
{
  const Particle sphere(dem::make_sphere(1.));
  const support::WallMesh mesh = support::box_corner(6.);
  const auto found = dem::find_on_facets(sphere.at(Vec3::Constant(0.99)),
                                         mesh.view(), all_of(mesh), 0.05);
  ASSERT_EQ(found.contact_points.size(), 3u);
  for (const dem::WallContactPoint &contact_point : found.contact_points)
    EXPECT_NEAR(contact_point.overlap, 0.01, 1e-12);
}
