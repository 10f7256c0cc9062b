#include "test_shapes.h"

#include <dem/shape/particle_shape.h>
#include <dem/shape/radius_bounds.h>

#include <gtest/gtest.h>

using namespace dem;

// A zonal harmonic has its largest derivatives at the pole, where they are
// those of P_n(cos t): -n (n + 1) / 2 for the second. No other series of that
// degree and energy has more, so the bound is met.
TEST(DerivativeBounds, AreMetByZonalHarmonics)
{
  for (const int n : {1, 2, 7, 20})
  {
    std::vector<double> a(std::size_t(n_coefficients(n)), 0.);
    a[std::size_t(harmonic_index(n, 0))] = 1.;
    const double peak = std::sqrt((2. * n + 1.) / (4. * std::numbers::pi));
    const DerivativeBounds bounds = derivative_bounds(a);
    EXPECT_NEAR(bounds.value, peak, 1e-12 * peak);
    const double second = 0.5 * n * (n + 1.) * peak;
    EXPECT_GE(bounds.second, second * (1. - 1e-12));
    EXPECT_LE(bounds.second, 1.25 * second);
  }
}

// x on the unit sphere: 1, and 1 for every derivative along a great circle.
TEST(DerivativeBounds, OfALinearFunctionAreOne)
{
  std::vector<double> a(4, 0.);
  a[3] = std::sqrt(4. * std::numbers::pi / 3.);
  const DerivativeBounds bounds = derivative_bounds(a);
  EXPECT_NEAR(bounds.value, 1., 1e-12);
  EXPECT_NEAR(bounds.first, 1., 1e-12);
  EXPECT_NEAR(bounds.second, 1., 1e-12);
  EXPECT_NEAR(bounds.third, 1., 1e-12);
}

// After small changes the bounds still hold, and are not much wider.
TEST(ParticleShape, BoundsOfAChangedShapeHold)
{
  ParticleShape body = shape_of(test::random_particle(20, 5));
  const std::vector<Vec3> directions = test::random_directions(3000, 5);
  for (int change = 1; change <= 40; ++change)
  {
    Coefficients a = scaled_coefficients(body);
    const std::vector<double> other =
        test::random_particle(20, 100 + unsigned(change));
    for (std::size_t j = 1; j < a.size(); ++j)
      a[j] += 0.02 * other[j];
    body = changed_shape(body, a);
    double largest = 0., smallest = 1., steepest = 0.;
    for (const Vec3 &s : directions)
    {
      const RadialExpansion at = expand(a, s);
      largest = std::max(largest, at.radius);
      smallest = std::min(smallest, at.radius);
      steepest = std::max(steepest, at.gradient.norm());
    }
    ASSERT_GE(body.circumscribed_radius, largest);
    ASSERT_LE(body.circumscribed_radius, 1.06 * largest);
    ASSERT_LE(body.least_radius, smallest);
    ASSERT_GE(body.max_slope, steepest);
    ASSERT_LE(body.max_slope, 1.4 * steepest);
  }
}
