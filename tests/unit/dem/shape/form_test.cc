#include "test_shapes.h"

#include <dem/shape/form.h>

#include <gtest/gtest.h>

#include <shape/convex_hull.h>

using namespace dem;
using namespace dem::test;

namespace
{
const Vec3 form_axes(0.012, 0.010, 0.007);

/// An ellipsoid whose axes stand askew.
std::vector<double> askew_ellipsoid()
{
  const Mat3 turn =
      Quaternion(0.3, -0.5, 0.2, 0.7).normalized().toRotationMatrix();
  return project(20, [&](const Vec3 &s)
                 { return ellipsoid_radius(form_axes, turn * s); });
}
} // namespace

// A box with points in its faces and inside of it.
TEST(ConvexHull, VolumeOfABox)
{
  std::vector<Vec3> points = random_directions(300, 1);
  for (Vec3 &point : points)
    point = point.cwiseMax(-0.5).cwiseMin(0.5);
  for (int i = 0; i < 8; ++i)
    points.emplace_back(i & 1 ? 0.5 : -0.5, i & 2 ? 0.5 : -0.5,
                        i & 4 ? 0.5 : -0.5);
  EXPECT_NEAR(detail::convex_hull_volume(points), 1., 1e-6);
}

TEST(ConvexHull, OfPointsInAPlaneHasNoVolume)
{
  EXPECT_EQ(detail::convex_hull_volume({}), 0.);
  std::vector<Vec3> points = random_directions(30, 2);
  for (Vec3 &point : points)
    point.z() = 0.3;
  EXPECT_EQ(detail::convex_hull_volume(points), 0.);
}

// Inscribed polyhedron of a sphere: all points are corners.
TEST(ConvexHull, OfASphereTendsToIt)
{
  const double volume = detail::convex_hull_volume(random_directions(4000, 3));
  const double sphere = 4. / 3. * std::numbers::pi;
  EXPECT_LT(volume, sphere);
  EXPECT_GT(volume, 0.995 * sphere);
}

// Nodes 1.1 degrees apart miss a tip of curvature 1.7e2 / m by 2e-4 of L.
TEST(Calipers, OfAnEllipsoidAreItsAxes)
{
  const Calipers of = calipers(askew_ellipsoid());
  EXPECT_NEAR(of.length, 2. * form_axes.x(), 1e-3 * form_axes.x());
  EXPECT_NEAR(of.width, 2. * form_axes.y(), 1e-3 * form_axes.x());
  EXPECT_NEAR(of.thickness, 2. * form_axes.z(), 1e-3 * form_axes.x());
}

// The diagonals of the quads between the rings may be notches: a part of the
// 6e-4 that the polyhedron lacks to the body.
TEST(Convexity, OfConvexShapesIsOne)
{
  EXPECT_NEAR(convexity(sphere_series(8, 0.01)), 1., 1e-6);
  EXPECT_NEAR(convexity(askew_ellipsoid()), 1., 3e-4);
  EXPECT_LE(convexity(askew_ellipsoid()), 1.);
}

// The nodes on the faces of a cube lie in planes, many to a row. Order 30 rings
// by some per cent about r = 1 / max|s|, whose hull is the cube.
TEST(Convexity, OfACubeLacksWhatItsEdgesLose)
{
  const double of = convexity(
      project(30, [](const Vec3 &s) { return 1. / s.cwiseAbs().maxCoeff(); }));
  EXPECT_GT(of, 0.93);
  EXPECT_LT(of, 1.);
}

// A dumbbell of revolution, r = 1 + 3/2 z^2: its hull fills the waist with the
// cylinder between the two rims. Both volumes by the midpoint rule.
TEST(Convexity, OfADumbbellIsThatOfItsProfile)
{
  const auto r = [](double z) { return 1. + 1.5 * z * z; };
  const auto a = project(8, [&](const Vec3 &s) { return r(s.z()); });
  const auto across = [&](double z) { return r(z) * std::sqrt(1. - z * z); };
  const int n = 2000;
  double volume = 0., rim = 0.;
  for (int i = 0; i < n; ++i) // V = 2 pi / 3 int r^3 dz
  {
    const double z = -1. + (2. * i + 1.) / n;
    volume += 2. * std::numbers::pi / 3. * std::pow(r(z), 3) * 2. / n;
    rim = std::max(rim, across(z));
  }
  double hull = 0.;
  bool is_past_rim = false;
  for (int i = 0; i < n; ++i) // pi int across^2 dh with h = z r(z)
  {
    const double z = (i + 0.5) / n, rise = (1. + 4.5 * z * z) / n;
    is_past_rim = is_past_rim || across(z) >= rim * (1. - 1e-6);
    const double radius = is_past_rim ? across(z) : rim;
    hull += 2. * std::numbers::pi * radius * radius * rise;
  }
  EXPECT_NEAR(convexity(a), volume / hull, 2e-3);
  EXPECT_LT(volume / hull, 0.95);
}

// A sphere whose series starts 0.3 of the radius off its centre.
TEST(InscribedSphere, FindsTheCentre)
{
  const Vec3 aside(1e-3, -2e-3, 1.5e-3);
  const auto r = [&](const Vec3 &s)
  {
    const double along = aside.dot(s);
    return along + std::sqrt(along * along - aside.squaredNorm() + 0.01 * 0.01);
  };
  const InscribedSphere sphere = inscribed_sphere(project(30, r));
  EXPECT_NEAR(sphere.radius, 0.01, 1e-6);
  EXPECT_NEAR((sphere.centre - aside).norm(), 0., 1e-5);
}

TEST(InscribedSphere, OfAnEllipsoidHasTheShortAxis)
{
  const InscribedSphere sphere = inscribed_sphere(askew_ellipsoid());
  EXPECT_NEAR(sphere.radius, form_axes.z(), 2e-4 * form_axes.z());
  EXPECT_LT(sphere.centre.norm(), 2e-2 * form_axes.z());
}
