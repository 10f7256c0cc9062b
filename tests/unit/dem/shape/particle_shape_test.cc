#include "test_shapes.h"

#include <dem/shape/measures.h>
#include <dem/shape/particle_shape.h>

#include <gtest/gtest.h>

using namespace dem;
using namespace dem::test;

TEST(ParticleShape, SphereHasNoSeries)
{
  const ParticleShape body = make_sphere(0.01);
  EXPECT_EQ(body.series, nullptr);
  EXPECT_DOUBLE_EQ(mean_radius(body), 0.01);
  EXPECT_NEAR(body.volume, 4. / 3. * std::numbers::pi * 1e-6, 1e-20);
  EXPECT_EQ(body.inscribed_radius, 0.01);
  EXPECT_EQ(body.circumscribed_radius, 0.01);
  EXPECT_EQ(body.max_slope, 0.);
  EXPECT_NEAR(radius(scaled_coefficients(body), Vec3::UnitX()), 0.01, 1e-16);
}

TEST(ParticleShape, SharesItsSeriesAndScales)
{
  const auto series =
      std::make_shared<const Coefficients>(random_particle(20, 1));
  const ParticleShape body = make_shape(series, 0.005);
  EXPECT_EQ(body.series, series);
  EXPECT_NEAR(mean_radius(body), 0.005, 1e-16);
  const ShapeMeasures of =
      measure_shape(scaled_coefficients(body), standard_quadrature());
  EXPECT_NEAR(body.volume, of.volume, 1e-12 * of.volume);
  EXPECT_NEAR(body.inscribed_radius, of.inscribed_radius, 1e-15);
  EXPECT_GT(body.circumscribed_radius, of.circumscribed_radius);
  EXPECT_GT(body.max_slope, of.max_slope);
}

TEST(ParticleShape, ResizedIsWhatMakeShapeGives)
{
  const auto series =
      std::make_shared<const Coefficients>(random_particle(20, 2));
  const ParticleShape small = resized(make_shape(series, 0.02), 0.005);
  const ParticleShape made = make_shape(series, 0.005);
  EXPECT_EQ(small.series, series);
  EXPECT_NEAR(small.scale, made.scale, 1e-15 * made.scale);
  EXPECT_NEAR(small.volume, made.volume, 1e-14 * made.volume);
  EXPECT_NEAR(small.max_slope, made.max_slope, 1e-14 * made.max_slope);
}

TEST(ParticleShape, RefusesACountThatIsNoSquare)
{
  EXPECT_THROW(shape_of(Coefficients(5, 1.)), std::invalid_argument);
}

// The bounds hold on a grid a hundred times finer than the nodes.
TEST(ParticleShape, BoundsHoldBetweenTheNodes)
{
  for (const unsigned seed : {3u, 4u, 5u})
  {
    const ParticleShape body = shape_of(random_particle(20, seed));
    for (const Vec3 &s : random_directions(20000, seed))
    {
      const RadialExpansion at = expand(*body.series, s);
      EXPECT_LE(at.radius, body.circumscribed_radius);
      EXPECT_LE(at.gradient.norm(), body.max_slope);
    }
  }
}

// An ellipsoid about a point off its centre: from there the surface is nearer
// than the radius of the largest sphere inside, its short axis.
TEST(ParticleShape, CornersMayBeToldByTheLargestSphere)
{
  const Vec3 axes(0.012, 0.010, 0.008), off(0., 0., 0.002);
  const auto series = std::make_shared<const Coefficients>(test::project(
      20,
      [&](const Vec3 &s)
      {
        // |off + r s| in the metric of the ellipsoid is one.
        const Vec3 u = s.cwiseQuotient(axes), o = off.cwiseQuotient(axes);
        const double b = u.dot(o), c = o.squaredNorm() - 1.;
        return (-b + std::sqrt(b * b - u.squaredNorm() * c)) / u.squaredNorm();
      }));
  ParticleShape body = shape_of(*series);
  EXPECT_EQ(body.corner_radius, body.inscribed_radius);
  EXPECT_NEAR(body.corner_radius, 0.006, 0.02 * 0.006);
  free_corner_radius(body, standard_quadrature());
  EXPECT_NEAR(body.corner_radius, 0.008, 5e-3 * 0.008);
  EXPECT_NEAR(resized(body, 2. * mean_radius(body)).corner_radius, 0.016,
              5e-3 * 0.016);
}
