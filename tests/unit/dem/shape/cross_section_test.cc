#include "test_shapes.h"

#include <dem/shape/cross_section.h>

#include <gtest/gtest.h>

#include <algorithm>

using namespace dem;
using namespace dem::test;

namespace
{
constexpr double pi = std::numbers::pi;

Mat3 some_rotation()
{
  return Quaternion(0.3, 0.5, -0.2, 0.7).normalized().toRotationMatrix();
}

/// Height over the width of the body r = a (1 + 1.2 (1 - u^2)) at u = cos of
/// the polar angle, its waist at u = 1 [a].
double bump_height(double u)
{
  return (2.2 - 1.2 * u * u) * u;
}

/// Where bump_height() is this, between two angles.
double bump_root(double height, double low, double high)
{
  const bool rises = bump_height(high) > bump_height(low);
  for (int k = 0; k < 60; ++k)
  {
    const double middle = 0.5 * (low + high);
    ((bump_height(middle) < height) == rises ? low : high) = middle;
  }
  return low;
}
} // namespace

// The section of an ellipsoid of half axes a by the plane n x = h is an ellipse
// of area pi abc / H (1 - h^2 / H^2) with H^2 = sum (a_i n_i)^2. The series of
// order 20 deviates by 2e-9 of the radius. The rest is the cubic between
// corners: 1e-7 with some 250 corners, 1e-5 with some 50 near the ends of the
// body.
TEST(CrossSection, IsThatOfAnEllipsoid)
{
  const Vec3 axes(0.012, 0.010, 0.008);
  const auto series =
      fit_radius([&](const Vec3 &s) { return ellipsoid_radius(axes, s); }, 20);
  const SectionedBody body(series);
  const Mat3 rotation = some_rotation();
  const double reach = axes.cwiseProduct(rotation.row(2).transpose()).norm();
  for (const double share : {-0.95, -0.5, -0.1, 0., 1e-9, 0.3, 0.9})
  {
    const double exact = pi * axes.prod() / reach * (1. - share * share);
    const auto section = body.section({rotation, share * reach});
    ASSERT_EQ(section.size(), 1u) << share;
    EXPECT_NEAR(section_area(section), exact,
                (std::abs(share) < 0.8 ? 5e-7 : 3e-5) * exact)
        << share;
    EXPECT_NEAR(polygon_area(section[0].corners), exact, 6e-3 * exact);
  }
  EXPECT_TRUE(body.section({rotation, 1.01 * reach}).empty());
  EXPECT_TRUE(body.section({rotation, -1.01 * reach}).empty());
}

// Corners are zeros of Newton's method to 1e-12 of a side.
TEST(CrossSection, CornersLieOnTheSurface)
{
  const auto series = random_particle(20, 3);
  const SectionedBody body(series, 2.);
  const SectionPlane plane{some_rotation(), -0.004};
  const auto section = body.section(plane);
  ASSERT_EQ(section.size(), 1u);
  EXPECT_GT(section[0].area, 0.);
  for (const Eigen::Vector2d &corner : section[0].corners)
  {
    const Vec3 point(corner.x(), corner.y(), plane.height);
    const Vec3 s = plane.rotation.transpose() * point.normalized();
    EXPECT_NEAR(point.norm(), 2. * radius(series, s), 1e-13);
  }
}

// r = a (1 + 1.2 x^2) has two lobes that reach higher than its waist.
TEST(CrossSection, HasTwoPartsAboveAWaist)
{
  const auto series = fit_radius(
      [](const Vec3 &s) { return 0.01 * (1. + 1.2 * s.x() * s.x()); }, 4);
  const SectionedBody body(series);
  EXPECT_EQ(body.section({Mat3::Identity(), 0.0095}).size(), 1u);
  const auto parts = body.section({Mat3::Identity(), 0.0105});
  ASSERT_EQ(parts.size(), 2u);
  EXPECT_GT(parts[0].area, 0.);
  EXPECT_NEAR(parts[0].area, parts[1].area, 1e-4 * parts[0].area);
}

// The same body about z: its section is a ring, radii from the two angles at
// which the meridian has this height.
TEST(CrossSection, HasAHoleRoundADimple)
{
  const auto series = fit_radius(
      [](const Vec3 &s) { return 0.01 * (1. + 1.2 * (1. - s.z() * s.z())); },
      4);
  const SectionedBody body(series);
  const double height = 1.07, top = std::sqrt(2.2 / 3.6);
  const auto radius_at = [&](double u)
  { return 0.01 * height * std::sqrt(1. - u * u) / u; };
  const double outer = radius_at(bump_root(height, 0.1, top)),
               inner = radius_at(bump_root(height, top, 1.));
  for (const double side : {1., -1.})
  {
    auto ring = body.section({Mat3::Identity(), side * 0.01 * height});
    ASSERT_EQ(ring.size(), 2u);
    std::ranges::sort(ring, {}, &SectionLoop::area);
    EXPECT_NEAR(ring[0].area, -pi * inner * inner, 1e-5 * inner * inner);
    EXPECT_NEAR(ring[1].area, pi * outer * outer, 1e-5 * outer * outer);
  }
}

// A sphere of 10 mm that has become an ellipsoid inside it has lost the ring
// between circle and ellipse; polygons of about 290 corners are 3e-4 small.
TEST(LostRegions, AreTheRingBetweenTwoSections)
{
  const Vec3 axes(0.0097, 0.0096, 0.0095);
  const auto before = sphere_series(4, 0.01),
             after = fit_radius(
                 [&](const Vec3 &s) { return ellipsoid_radius(axes, s); }, 20);
  const SectionedBody first(before), now(after);
  const SectionPlane plane{Mat3::Identity(), 0.003};
  const double share = 1. - std::pow(plane.height / axes.z(), 2),
               circle = pi * (1e-4 - std::pow(plane.height, 2)),
               lost = circle - pi * axes.x() * axes.y() * share;
  const LostRegions ring = lost_regions(first, now, plane, 0.);
  EXPECT_NEAR(ring.area_before, circle, 1e-6 * circle);
  ASSERT_EQ(ring.regions.size(), 1u);
  EXPECT_NEAR(polygon_area(ring.regions), lost, 1e-2 * lost);
  EXPECT_NEAR(ring.area_before - section_area(now.section(plane)), lost,
              1e-4 * lost);
  EXPECT_TRUE(lost_regions(first, now, plane, 0.001).regions.empty());
  // Above all that is left of it, the whole circle is gone.
  const LostRegions cap =
      lost_regions(first, now, {Mat3::Identity(), 0.0098}, 0.);
  ASSERT_EQ(cap.regions.size(), 1u);
  EXPECT_NEAR(polygon_area(cap.regions), cap.area_before,
              1e-2 * cap.area_before);
}

// The dimple of above with a lip that is low on one side: its section is a
// crescent that loses a skin. On its hollow side the centroid lies away from
// what is left: regions that went towards it were a quarter too small.
TEST(LostRegions, FollowAHollowOutline)
{
  const auto lipped = fit_radius(
      [](const Vec3 &s)
      { return 0.01 * (1. + 1.2 * (1. - s.z() * s.z()) - 0.3 * s.y()); },
      8);
  const SectionedBody before(lipped), after(lipped, 0.995);
  const SectionPlane plane{Mat3::Identity(), 0.0101};
  const LostRegions lost = lost_regions(before, after, plane, 0.);
  const double expected = lost.area_before - section_area(after.section(plane));
  ASSERT_EQ(lost.regions.size(), 1u);
  EXPECT_NEAR(polygon_area(lost.regions), expected, 5e-3 * expected);
}

TEST(Polygon, AreaCentroidAndSimplification)
{
  const Polygon square = {{1., 1.}, {2., 1.}, {3., 1.}, {3., 3.}, {1., 3.}};
  EXPECT_DOUBLE_EQ(polygon_area(square), 4.);
  EXPECT_NEAR((polygon_centroid(square) - Eigen::Vector2d(2., 2.)).norm(), 0.,
              1e-15);
  EXPECT_EQ(simplified(square, 1e-9).size(), 4u);
  const Polygon circle = circle_polygon({0.5, -1.}, 2.);
  EXPECT_NEAR(polygon_area(circle), 36. * 4. * std::sin(pi / 36.), 1e-12);
  const Polygon coarse = simplified(circle, 0.05);
  EXPECT_LT(coarse.size(), 30u);
  EXPECT_NEAR(polygon_area(coarse), 4. * pi, 0.04 * 4. * pi);
}
