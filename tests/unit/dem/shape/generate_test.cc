#include "test_shapes.h"

#include <dem/shape/generate.h>
#include <dem/shape/measures.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <shape/log_shape.h>

using namespace dem;
using namespace dem::test;

namespace
{
/// Ellipsoids askew with some roughness: log b / a about -0.3, log c / b about
/// -0.2, both +- 0.1.
std::vector<Coefficients> rough_ellipsoids(std::size_t n)
{
  std::mt19937 generator(7);
  std::normal_distribution<double> normal;
  Random random(3);
  std::vector<Coefficients> sample;
  for (std::size_t i = 0; i < n; ++i)
  {
    const double b = std::exp(-0.3 + 0.1 * normal(generator));
    const double c = b * std::exp(-0.2 + 0.1 * normal(generator));
    const Vec3 axes = 0.01 * Vec3(1., b, c);
    const Mat3 turn = random.rotation().toRotationMatrix();
    Coefficients shape = project(14, [&](const Vec3 &s)
                                 { return ellipsoid_radius(axes, turn * s); });
    for (int degree = 3; degree <= 14; ++degree)
      for (int m = -degree; m <= degree; ++m)
        shape[std::size_t(harmonic_index(degree, m))] +=
            4e-3 * normal(generator) / (degree * degree);
    sample.push_back(shape);
  }
  return sample;
}

struct Spread
{
  double mean = 0., deviation = 0.;
};

Spread spread(const std::vector<Coefficients> &shapes,
              double detail::LogShape::*number)
{
  Spread of;
  std::vector<double> values;
  for (const Coefficients &shape : shapes)
    values.push_back(detail::log_shape(shape, 14).*number);
  for (const double value : values)
    of.mean += value / double(values.size());
  for (const double value : values)
    of.deviation += std::pow(value - of.mean, 2) / double(values.size() - 1);
  of.deviation = std::sqrt(of.deviation);
  return of;
}

std::vector<Coefficients> generated(const ShapeGenerator &generator, int n,
                                    std::uint64_t seed)
{
  Random random(seed);
  std::vector<Coefficients> particles;
  for (int i = 0; i < n; ++i)
    particles.push_back(generator(random));
  return particles;
}

std::string message_of(std::span<const Coefficients> sample, int order)
{
  try
  {
    ShapeGenerator generator(sample, order);
  }
  catch (const std::invalid_argument &error)
  {
    return error.what();
  }
  return "";
}
} // namespace

TEST(LogShape, ParityIsThatOfTheHarmonics)
{
  const Vec3 s = Vec3(0.3, 0.5, 0.7).normalized();
  std::vector<double> here(49), there(49);
  evaluate_harmonics(6, s, here);
  for (int axis = 0; axis < 3; ++axis)
  {
    Vec3 mirrored = s;
    mirrored[axis] = -s[axis];
    evaluate_harmonics(6, mirrored, there);
    for (int n = 0; n <= 6; ++n)
      for (int m = -n; m <= n; ++m)
      {
        const auto j = std::size_t(harmonic_index(n, m));
        const bool is_odd = detail::parity_of(n, m) & (1 << axis);
        EXPECT_NEAR(there[j], is_odd ? -here[j] : here[j], 1e-13);
      }
  }
}

// A particle with its own numbers comes back, turned into its principal frame.
// The quantiles hold 64 steps of it, the order cuts exp(log r).
TEST(LogShape, ComesBackAsTheParticle)
{
  for (const Coefficients &shape : rough_ellipsoids(3))
  {
    const detail::LogShape log = detail::log_shape(shape, 20);
    const ShapeMeasures was = measure_shape(shape, standard_quadrature());
    const ShapeMeasures is =
        measure_shape(detail::from_log(log), standard_quadrature());
    EXPECT_NEAR(is.volume, was.volume, 1e-9 * was.volume);
    EXPECT_NEAR(is.area, was.area, 3e-3 * was.area);
    const Vec3 moments =
        Eigen::SelfAdjointEigenSolver<Mat3>(was.inertia).eigenvalues();
    EXPECT_LT((is.inertia.diagonal() - moments).norm(), 1e-2 * moments.norm());
    EXPECT_LT(is.inertia(0, 1), 1e-2 * moments.x());
  }
}

TEST(LogShape, OfAnEllipsoidIsItsAxes)
{
  const Vec3 axes(0.012, 0.010, 0.009);
  const Mat3 turn =
      Quaternion(0.3, -0.5, 0.2, 0.7).normalized().toRotationMatrix();
  const detail::LogShape log =
      detail::log_shape(project(24, [&](const Vec3 &s)
                                { return ellipsoid_radius(axes, turn * s); }),
                        20);
  EXPECT_NEAR(log.log_elongation, std::log(10. / 12.), 1e-6);
  EXPECT_NEAR(log.log_flatness, std::log(9. / 10.), 1e-6);
  EXPECT_NEAR(log.volume_equivalent_radius, std::cbrt(axes.prod()), 1e-10);
  for (const double b : log.coefficients)
    EXPECT_NEAR(b, 0., 1e-6);
}

TEST(ShapeGenerator, SameSeedSameParticles)
{
  const ShapeGenerator generator(rough_ellipsoids(4), 12);
  const auto few = generated(generator, 2, 5),
             many = generated(generator, 3, 5);
  EXPECT_EQ(few[0], many[0]);
  EXPECT_EQ(few[1], many[1]);
  EXPECT_NE(few[0], few[1]);
  EXPECT_NE(few[0], generated(generator, 1, 6)[0]);
}

TEST(ShapeGenerator, ParticlesAreStarsAboutTheirCentroid)
{
  const std::vector<Coefficients> sample = rough_ellipsoids(5);
  const ShapeGenerator generator(sample, 20);
  const SphereQuadrature fine = make_quadrature(100, 200);
  const double r = generator.volume_equivalent_radius();
  double logs = 0.;
  for (const Coefficients &shape : sample)
    logs += std::log(measure_shape(shape, standard_quadrature()).volume) / 15.;
  EXPECT_NEAR(r, std::cbrt(0.75 / std::numbers::pi) * std::exp(logs), 1e-12);
  for (const Coefficients &particle : generated(generator, 20, 1))
  {
    const ShapeMeasures of = measure_shape(particle, standard_quadrature());
    EXPECT_NEAR(of.volume, 4. / 3. * std::numbers::pi * r * r * r,
                1e-12 * of.volume);
    EXPECT_LT(of.centroid.norm(), 1e-10 * r);
    const std::vector<double> radii = node_radii(particle, fine);
    EXPECT_GT(*std::min_element(radii.begin(), radii.end()), 0.05 * r);
  }
}

// Means within three standard errors of 150 particles; the deviation, from 20
// particles of the sample, is drawn as it is and comes back within its own
// error of 1 / sqrt(2 * 150) = 6 %, three times.
TEST(ShapeGenerator, ReproducesTheFormsOfTheSample)
{
  const std::vector<Coefficients> sample = rough_ellipsoids(20);
  const auto particles = generated(ShapeGenerator(sample, 14), 150, 2);
  for (const auto number :
       {&detail::LogShape::log_elongation, &detail::LogShape::log_flatness})
  {
    const Spread was = spread(sample, number), is = spread(particles, number);
    EXPECT_NEAR(is.mean, was.mean, 3. * was.deviation / std::sqrt(150.));
    EXPECT_NEAR(is.deviation, was.deviation, 0.2 * was.deviation);
  }
  const auto energy = [](const std::vector<Coefficients> &shapes)
  {
    double sum = 0.;
    for (const Coefficients &shape : shapes)
      sum += detail::high_energy(detail::log_shape(shape, 14).coefficients) /
             double(shapes.size());
    return sum;
  };
  EXPECT_NEAR(energy(particles), energy(sample), 0.1 * energy(sample));
}

TEST(ShapeGenerator, OfEqualSpheresMakesSpheres)
{
  const std::vector<Coefficients> sample(3, sphere_series(8, 0.01));
  for (const Coefficients &particle :
       generated(ShapeGenerator(sample, 8), 2, 1))
    for (const Vec3 &s : random_directions(20, 1))
      EXPECT_NEAR(radius(particle, s), 0.01, 1e-7);
}

TEST(ShapeGenerator, SaysWhatItNeeds)
{
  const std::vector<Coefficients> sample = rough_ellipsoids(3);
  EXPECT_EQ(message_of(sample, 5), "");
  EXPECT_NE(message_of(std::span(sample).first(2), 8).find("at least 3"),
            std::string::npos);
  EXPECT_NE(message_of(sample, 4).find("5 .. 30"), std::string::npos);
  EXPECT_NE(message_of(sample, 31).find("5 .. 30"), std::string::npos);
  const std::vector<Coefficients> coarse(3, sphere_series(3, 0.01));
  EXPECT_NE(message_of(coarse, 8).find("order below 4"), std::string::npos);
}
