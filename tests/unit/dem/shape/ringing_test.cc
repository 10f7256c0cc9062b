#include "test_shapes.h"

#include <dem/shape/ringing.h>

#include <gtest/gtest.h>

using namespace dem;
using namespace dem::test;

namespace
{
std::vector<double> ellipsoid(int order)
{
  return project(order, [](const Vec3 &s)
                 { return ellipsoid_radius(Vec3(0.012, 0.010, 0.009), s); });
}

std::vector<double> cube(int order)
{
  return project(order,
                 [](const Vec3 &s) { return 0.01 / s.cwiseAbs().maxCoeff(); });
}
} // namespace

TEST(Ringing, OfASmoothShapeIsZero)
{
  EXPECT_EQ(ringing(sphere_series(20, 0.01)).rms, 0.);
  EXPECT_LT(ringing(ellipsoid(20)).rms, 1e-6);
  EXPECT_LT(ringing(ellipsoid(20)).largest, 1e-5);
}

// The edges of a cube are kinks of r: energy falls as a power of the degree.
TEST(Ringing, OfACubeIsLargeAndLastsLong)
{
  const Ringing coarse = ringing(cube(8)), fine = ringing(cube(30));
  EXPECT_GT(coarse.rms, 1e-2);
  EXPECT_GT(fine.rms, 1e-3);
  EXPECT_GT(fine.rms, 1e4 * ringing(ellipsoid(30)).rms);
  EXPECT_GT(fine.largest, fine.rms);
}

// One coefficient of the upper third, by hand.
TEST(Ringing, IsTheShareOfTheUpperThirdOfTheDegrees)
{
  std::vector<double> a = sphere_series(9, 0.01);
  a[std::size_t(harmonic_index(6, 2))] = a[0];
  EXPECT_EQ(ringing(a).rms, 0.);
  a[std::size_t(harmonic_index(7, 0))] = 0.1 * a[0];
  EXPECT_NEAR(ringing(a).rms, 0.1, 1e-15);
  // |Y_70| is largest at the pole, sqrt(15) of Y_00; the last ring is near it
  EXPECT_NEAR(ringing(a).largest, 0.1 * std::sqrt(15.), 0.02);
}
