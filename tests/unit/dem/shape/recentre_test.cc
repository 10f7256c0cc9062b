#include "test_shapes.h"

#include <dem/shape/recentre.h>

#include <gtest/gtest.h>

using namespace dem;

namespace
{
/// An ellipsoid about a point off its centre: |off + r s| in its metric is one.
std::vector<double> off_centre(const Vec3 &axes, const Vec3 &off)
{
  return test::project(
      20,
      [&](const Vec3 &s)
      {
        const Vec3 u = s.cwiseQuotient(axes), o = off.cwiseQuotient(axes);
        const double b = u.dot(o), c = o.squaredNorm() - 1.;
        return (-b + std::sqrt(b * b - u.squaredNorm() * c)) / u.squaredNorm();
      });
}
} // namespace

// The centroid of an ellipsoid is its centre: seen from `off` it is at -off.
TEST(Recentre, FindsTheCentreOfAnEllipsoid)
{
  const Vec3 axes(0.012, 0.010, 0.008), off(5e-4, -3e-4, 6e-4);
  const std::vector<double> series = off_centre(axes, off);
  const double mean = series[0] * equivalent_radius_factor;
  // What order 20 leaves of it is 1e-5 of the radius.
  EXPECT_NEAR(relative_centroid(series).norm(), off.norm() / mean, 1e-4);
  const Recentred moved = recentre(series);
  EXPECT_LT((moved.shift + off).norm(), 1e-4 * mean);
  EXPECT_LT(relative_centroid(moved.coefficients).norm(), 1e-6);
  EXPECT_LT(moved.deviation, 1e-4);
  for (const Vec3 &s : test::random_directions(200, 3))
    EXPECT_NEAR(radius(moved.coefficients, s), test::ellipsoid_radius(axes, s),
                2e-4 * mean);
}

TEST(Recentre, LeavesACentredSeriesAsItIs)
{
  const std::vector<double> series = test::sphere_series(8, 0.01);
  const Recentred moved = recentre(series);
  EXPECT_EQ(moved.coefficients, series);
  EXPECT_EQ(moved.shift, Vec3(Vec3::Zero()));
  EXPECT_EQ(moved.deviation, 0.);
}
