#include "test_shapes.h"

#include <dem/shape/measures.h>

#include <gtest/gtest.h>

#include <algorithm>

using namespace dem;
using namespace dem::test;

namespace
{
constexpr double pi = std::numbers::pi;

std::vector<double> ellipsoid(const Vec3 &axes)
{
  return project(30, [&](const Vec3 &s) { return ellipsoid_radius(axes, s); });
}
} // namespace

TEST(Measures, OfASphere)
{
  const double r = 0.013;
  const ShapeMeasures of =
      measure_shape(sphere_series(20, r), standard_quadrature());
  const double volume = 4. / 3. * pi * r * r * r;
  EXPECT_NEAR(of.volume, volume, 1e-12 * volume);
  EXPECT_NEAR(of.area, 4. * pi * r * r, 1e-12 * r * r);
  EXPECT_NEAR(of.centroid.norm(), 0., 1e-14 * r);
  EXPECT_LT((of.inertia - 0.4 * volume * r * r * Mat3::Identity()).norm(),
            1e-12 * volume * r * r);
  EXPECT_NEAR(of.inscribed_radius, r, 1e-14);
  EXPECT_NEAR(of.circumscribed_radius, r, 1e-14);
  EXPECT_NEAR(of.mean_radius, r, 1e-14);
  EXPECT_NEAR(of.max_slope, 0., 1e-12 * r);
  EXPECT_NEAR(of.max_curvature * r, 1., 1e-10);
  EXPECT_NEAR(of.sphericity, 1., 1e-12);
}

TEST(Measures, PerfectSphereHasNoCorner)
{
  const ShapeMeasures of =
      measure_shape(sphere_series(20, 0.01), standard_quadrature());
  EXPECT_EQ(of.corner_fraction, 0.);
  EXPECT_EQ(of.roundness, 1.);
  EXPECT_FALSE(is_corner(100., 0.01));
  EXPECT_FALSE(is_corner(100. * (1. + 0.9e-3), 0.01));
  EXPECT_TRUE(is_corner(100. * (1. + 1.1e-3), 0.01));
  EXPECT_FALSE(is_corner(-1e4, 0.01));
}

// The truncation at degree 30 is 1e-10 of r. The area of an oblate spheroid:
// 2 pi a^2 + pi c^2 / e ln((1 + e) / (1 - e)), e^2 = 1 - c^2 / a^2.
TEST(Measures, OfAnOblateSpheroid)
{
  const double a = 0.012, c = 0.009, e = std::sqrt(1. - c * c / (a * a));
  const ShapeMeasures of =
      measure_shape(ellipsoid(Vec3(a, a, c)), standard_quadrature());
  const double volume = 4. / 3. * pi * a * a * c;
  const double area =
      2. * pi * a * a + pi * c * c / e * std::log((1. + e) / (1. - e));
  EXPECT_NEAR(of.volume, volume, 1e-8 * volume);
  EXPECT_NEAR(of.area, area, 1e-7 * area);
  // On the equator; the nearest nodes, half a ring aside, have 3.1e-3 less.
  EXPECT_NEAR(of.max_curvature, a / (c * c), 5e-3 * a / (c * c));
}

TEST(Measures, InertiaOfAnEllipsoid)
{
  const Vec3 axes(0.012, 0.010, 0.009);
  const ShapeMeasures of =
      measure_shape(ellipsoid(axes), standard_quadrature());
  const double volume = 4. / 3. * pi * axes.prod();
  const Vec3 squares = axes.cwiseProduct(axes);
  const Vec3 exact = volume / 5. *
                     Vec3(squares.y() + squares.z(), squares.x() + squares.z(),
                          squares.x() + squares.y());
  const Mat3 inertia = exact.asDiagonal();
  EXPECT_LT((of.inertia - inertia).norm(), 1e-8 * exact.norm());
}

// A sphere whose origin is aside by d: volume, centroid and inertia about the
// centroid do not know of the origin.
TEST(Measures, DoNotDependOnTheOriginOfTheSeries)
{
  const double radius_of_sphere = 0.01;
  const Vec3 aside(1e-3, -2e-3, 1.5e-3);
  const auto r = [&](const Vec3 &s)
  {
    const double along = aside.dot(s);
    return along + std::sqrt(along * along - aside.squaredNorm() +
                             radius_of_sphere * radius_of_sphere);
  };
  const ShapeMeasures of = measure_shape(project(30, r), standard_quadrature());
  const double volume = 4. / 3. * pi * std::pow(radius_of_sphere, 3);
  EXPECT_NEAR(of.volume, volume, 1e-9 * volume);
  EXPECT_NEAR((of.centroid - aside).norm(), 0., 1e-9 * radius_of_sphere);
  const double moment = 0.4 * volume * radius_of_sphere * radius_of_sphere;
  EXPECT_LT((of.inertia - moment * Mat3::Identity()).norm(), 1e-8 * moment);
}

// The nodes turn with nothing: the rule is exact for r^3 of order 20.
TEST(Measures, VolumeDoesNotChangeUnderRotation)
{
  const std::vector<double> a = random_particle(20, 10);
  const Quaternion rotation(0.3, -0.5, 0.2, 0.7);
  const Mat3 turn = rotation.normalized().toRotationMatrix();
  const std::vector<double> turned =
      project(20, [&](const Vec3 &s) { return radius(a, turn * s); });
  for (const Vec3 &s : random_directions(20, 11))
    EXPECT_NEAR(radius(turned, s), radius(a, turn * s), 1e-13);
  const SphereQuadrature &rule = standard_quadrature();
  const double before = volume(node_radii(a, rule), rule);
  EXPECT_NEAR(volume(node_radii(turned, rule), rule), before, 1e-12 * before);
}

// R_g by Eq. 30 written out again over the nodes.
TEST(Measures, RoundnessIsTheMeanCornerRadius)
{
  const std::vector<double> a = ellipsoid(Vec3(0.012, 0.010, 0.009));
  const double of = roundness(a, standard_quadrature());
  EXPECT_EQ(of, measure_shape(a, standard_quadrature()).roundness);
  // corners have 1 / kappa_max below r_ins, the sharpest tip c b / a... of
  // curvature a / c^2
  EXPECT_LT(of, 1.);
  EXPECT_GT(of, 0.009 * 0.009 / 0.012 / 0.009);
}
