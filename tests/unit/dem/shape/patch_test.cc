#include "test_shapes.h"

#include <dem/shape/patch.h>

#include <gtest/gtest.h>

using namespace dem;
using namespace dem::test;

namespace
{
/// Of x^2/a^2 + y^2/b^2 + z^2/c^2 = 1 at x: K = h^4 / (a b c)^2 and
/// 2 H = h^3 (sum a^2 - |x|^2) / (a b c)^2 with 1 / h^2 = sum x_i^2 / a_i^4.
struct Curvatures
{
  double maximum, minimum;
  Vec3 normal;
};

Curvatures of_ellipsoid(const Vec3 &axes, const Vec3 &x)
{
  const Vec3 gradient = x.cwiseQuotient(axes.cwiseProduct(axes));
  const double h = 1. / gradient.norm(), product = axes.prod();
  const double gauss = std::pow(h, 4) / std::pow(product, 2);
  const double mean = 0.5 * std::pow(h, 3) *
                      (axes.squaredNorm() - x.squaredNorm()) /
                      std::pow(product, 2);
  const double gap = std::sqrt(std::max(0., mean * mean - gauss));
  return {mean + gap, mean - gap, gradient.normalized()};
}
} // namespace

TEST(PrincipalCurvatures, OfASphereAreItsInverseRadius)
{
  const std::vector<double> a = sphere_series(20, 0.02);
  for (const Vec3 &s : random_directions(10, 5))
  {
    const PrincipalCurvatures at = principal_curvatures(expand(a, s));
    EXPECT_NEAR(at.maximum, 50., 1e-9);
    EXPECT_NEAR(at.minimum, 50., 1e-9);
    EXPECT_NEAR((at.normal - s).norm(), 0., 1e-12);
    EXPECT_NEAR(at.max_direction.norm(), 1., 1e-12);
    EXPECT_NEAR(at.max_direction.dot(s), 0., 1e-12);
  }
}

// Order 30 carries this ellipsoid to 1e-10 of r; two derivatives cost up to
// 30^2 of that.
TEST(PrincipalCurvatures, OfAnEllipsoidAreTheClosedForm)
{
  const Vec3 axes(0.012, 0.010, 0.009);
  const auto r = [&](const Vec3 &s) { return ellipsoid_radius(axes, s); };
  const std::vector<double> a = project(30, r);
  std::vector<Vec3> directions = random_directions(50, 6);
  directions.push_back(Vec3::UnitZ());
  directions.push_back(-Vec3::UnitZ());
  for (const Vec3 &s : directions)
  {
    const PrincipalCurvatures at = principal_curvatures(expand(a, s));
    const Curvatures exact = of_ellipsoid(axes, r(s) * s);
    EXPECT_NEAR(at.maximum, exact.maximum, 1e-6 * exact.maximum);
    EXPECT_NEAR(at.minimum, exact.minimum, 1e-6 * exact.minimum);
    EXPECT_NEAR((at.normal - exact.normal).norm(), 0., 1e-7);
  }
}

// The curvature of the normal section along t is t.(dn/dt): walk a little
// along the direction and see the normal turn by kappa_max.
TEST(PrincipalCurvatures, DirectionIsWhereTheNormalTurnsFastest)
{
  const std::vector<double> a = random_particle(12, 7);
  const double step = 1e-5;
  for (const Vec3 &s : random_directions(20, 8))
  {
    const RadialExpansion here = expand(a, s);
    const PrincipalCurvatures at = principal_curvatures(here);
    const auto normal_at = [&](double length)
    {
      const Vec3 x = here.radius * s + length * here.radius * at.max_direction;
      return principal_curvatures(expand(a, x.normalized())).normal;
    };
    const Vec3 turn =
        (normal_at(step) - normal_at(-step)) / (2. * step * here.radius);
    EXPECT_NEAR(at.max_direction.dot(at.normal), 0., 1e-12);
    const double scale = std::abs(at.maximum) + std::abs(at.minimum);
    EXPECT_NEAR((turn - at.maximum * at.max_direction).norm(), 0.,
                1e-5 * scale);
  }
}

TEST(PrincipalCurvatures, SumUpToGaussBonnet)
{
  const std::vector<double> a = random_particle(10, 9);
  const SphereQuadrature &rule = standard_quadrature();
  double total = 0.;
  for (std::size_t k = 0; k < rule.weight.size(); ++k)
  {
    const RadialExpansion at = expand(a, rule.direction[k]);
    const PrincipalCurvatures kappa = principal_curvatures(at);
    total += rule.weight[k] * at.radius *
             std::hypot(at.radius, at.gradient.norm()) * kappa.maximum *
             kappa.minimum;
  }
  // the integrand is no polynomial: what the rule leaves
  EXPECT_NEAR(total, 4. * std::numbers::pi, 1e-6);
}
