#include "test_shapes.h"

#include <gtest/gtest.h>

using namespace dem;
using namespace dem::test;

namespace
{
/// Y_nm from the standard library, which has the phase (-1)^m.
double reference(int n, int m, const Vec3 &s)
{
  const auto order = unsigned(std::abs(m));
  const double polar = std::atan2(std::hypot(s.x(), s.y()), s.z());
  const double azimuth = std::atan2(s.y(), s.x());
  const double phase = order % 2 == 0 ? 1. : -1.;
  const double legendre = phase * std::sph_legendre(unsigned(n), order, polar);
  if (m > 0)
    return std::sqrt(2.) * legendre * std::cos(m * azimuth);
  if (m < 0)
    return std::sqrt(2.) * legendre * std::sin(-m * azimuth);
  return legendre;
}

std::vector<Vec3> directions_with_poles()
{
  std::vector<Vec3> directions = random_directions(40, 1);
  for (const Vec3 &axis : {Vec3(0, 0, 1), Vec3(0, 0, -1), Vec3(1, 0, 0),
                           Vec3(0, -1, 0), Vec3(1e-9, 0, 1)})
    directions.push_back(axis.normalized());
  return directions;
}
} // namespace

TEST(SphericalHarmonics, AgreeWithStandardLibraryToOrder20)
{
  std::vector<double> y(std::size_t(n_coefficients(20)));
  for (const Vec3 &s : directions_with_poles())
  {
    // the reference works with cos(theta) and loses theta near the pole
    if (std::hypot(s.x(), s.y()) > 0. && std::hypot(s.x(), s.y()) < 1e-2)
      continue;
    evaluate_harmonics(20, s, y);
    for (int n = 0; n <= 20; ++n)
      for (int m = -n; m <= n; ++m)
        EXPECT_NEAR(y[std::size_t(harmonic_index(n, m))], reference(n, m, s),
                    1e-12)
            << "n " << n << " m " << m;
  }
}

TEST(SphericalHarmonics, FirstDegreeHasTheSignsOfTheModel)
{
  const Vec3 s = Vec3(1, 2, 3).normalized();
  const double c = std::sqrt(3. / (4. * std::numbers::pi));
  std::vector<double> y(4);
  evaluate_harmonics(1, s, y);
  EXPECT_NEAR(y[std::size_t(harmonic_index(1, 1))], c * s.x(), 1e-15);
  EXPECT_NEAR(y[std::size_t(harmonic_index(1, -1))], c * s.y(), 1e-15);
  EXPECT_NEAR(y[std::size_t(harmonic_index(1, 0))], c * s.z(), 1e-15);
}

TEST(SphericalHarmonics, AreOrthonormalUnderTheStandardRule)
{
  const SphereQuadrature &rule = standard_quadrature();
  const auto size = Eigen::Index(n_coefficients(20));
  Eigen::MatrixXd table(size, Eigen::Index(rule.weight.size()));
  for (std::size_t k = 0; k < rule.weight.size(); ++k)
  {
    auto column = table.col(Eigen::Index(k));
    evaluate_harmonics(20, rule.direction[k],
                       {column.data(), std::size_t(size)});
    column *= std::sqrt(rule.weight[k]);
  }
  const Eigen::MatrixXd gram = table * table.transpose();
  EXPECT_LT(
      (gram - Eigen::MatrixXd::Identity(size, size)).cwiseAbs().maxCoeff(),
      1e-12);
}

TEST(SphericalHarmonics, OrderOfACountOfCoefficients)
{
  EXPECT_EQ(order_of(1), 0);
  EXPECT_EQ(order_of(441), 20);
  EXPECT_EQ(order_of(961), 30);
  EXPECT_EQ(order_of(0), -1);
  EXPECT_EQ(order_of(440), -1);
  EXPECT_EQ(order_of(1024), -1);
}

TEST(RadialExpansion, ValueIsTheSumOfTheSeries)
{
  const std::vector<double> a = random_particle(20, 2);
  std::vector<double> y(a.size());
  for (const Vec3 &s : directions_with_poles())
  {
    evaluate_harmonics(20, s, y);
    const double sum =
        Eigen::Map<const Eigen::VectorXd>(a.data(), Eigen::Index(a.size()))
            .dot(Eigen::Map<const Eigen::VectorXd>(y.data(),
                                                   Eigen::Index(y.size())));
    EXPECT_NEAR(radius(a, s), sum, 1e-14 * a[0]);
    EXPECT_NEAR(expand(a, s).radius, sum, 1e-14 * a[0]);
  }
}

// Along the great circle s cos t + v sin t the first and second derivatives of
// r are g.v and v.H.v (a geodesic has no curvature of its own). Five-point
// differences with t = 3e-3 leave (20 t)^4 / 30 ~ 4e-7 of the derivatives of
// degree 20, and those are a small part of a particle.
TEST(RadialExpansion, DerivativesAreThoseAlongGreatCircles)
{
  const std::vector<double> a = random_particle(20, 3);
  const double t = 3e-3, mean = 0.01;
  for (const Vec3 &s : directions_with_poles())
  {
    const RadialExpansion at = expand(a, s);
    const Tangents frame = tangents(s);
    for (const Vec3 &v : {frame.first, frame.second,
                          Vec3((frame.first + frame.second).normalized())})
    {
      const auto r = [&](double angle)
      { return radius(a, std::cos(angle) * s + std::sin(angle) * v); };
      const double slope =
          (8. * (r(t) - r(-t)) - (r(2. * t) - r(-2. * t))) / (12. * t);
      const double bend =
          (16. * (r(t) + r(-t)) - (r(2. * t) + r(-2. * t)) - 30. * r(0.)) /
          (12. * t * t);
      EXPECT_NEAR(at.gradient.dot(v), slope, 1e-6 * mean);
      EXPECT_NEAR(v.dot(at.hessian * v), bend, 2e-5 * mean);
    }
  }
}

TEST(RadialExpansion, IsTangentAndHasTheLaplacianOfItsDegree)
{
  for (const Vec3 &s : directions_with_poles())
    for (int n = 1; n <= 20; ++n)
    {
      std::vector<double> a(std::size_t(n_coefficients(20)), 0.);
      for (int m = -n; m <= n; ++m)
        a[std::size_t(harmonic_index(n, m))] = 1. / (1. + std::abs(m - 1));
      const RadialExpansion at = expand(a, s);
      EXPECT_NEAR(at.gradient.dot(s), 0., 1e-12 * n * n);
      EXPECT_NEAR((at.hessian * s).norm(), 0., 1e-11 * n * n);
      EXPECT_NEAR(at.hessian.trace(), -n * (n + 1.) * at.radius,
                  1e-11 * n * n * n);
    }
}
