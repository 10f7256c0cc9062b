#include "../shape/test_shapes.h"

#include <dem/breakage/update.h>
#include <dem/shape/measures.h>

#include <gtest/gtest.h>

using namespace dem;
using namespace dem::test;

namespace
{
constexpr double kernel_floor = 2.5;

Body stone(unsigned seed)
{
  return make_body(std::make_shared<const Coefficients>(random_stone(20, seed)),
                   0.01);
}

/// An event as a contact of this overlap on a corner of 5 mm makes it.
Spall spall_at(const Vec3 &u, double overlap = 1e-4)
{
  const double gauss = 1. / (0.005 * 0.005);
  return {u, cap_of(overlap, gauss).volume, overlap, gauss};
}
} // namespace

// k_n from its definition by Simpson's rule with 20 000 steps: its error is
// h^4 / 180 times the fourth derivative, 1e-16 30^4, and round-off.
TEST(KernelSpectrum, IsTheProjectionOfTheKernel)
{
  const int n_steps = 20000;
  const double h = std::numbers::pi / n_steps;
  for (const double width : {0.0833, 0.125, 0.3, 0.25 * std::numbers::pi})
  {
    const std::vector<double> spectrum = kernel_spectrum(width, 30);
    ASSERT_EQ(spectrum.size(), 31u);
    for (const unsigned n : {0u, 1u, 2u, 7u, 20u, 30u})
    {
      double sum = 0.;
      for (int i = 0; i <= n_steps; ++i)
      {
        const double gamma = h * i;
        const double weight = h / 3. *
                              (i == 0 || i == n_steps ? 1.
                               : i % 2 == 1           ? 4.
                                                      : 2.);
        sum += weight * 2. * std::numbers::pi * std::sin(gamma) *
               std::exp(-0.5 * std::pow(gamma / width, 2)) *
               std::legendre(n, std::cos(gamma));
      }
      EXPECT_NEAR(spectrum[n], sum, 1e-11 * spectrum[0]);
    }
  }
}

// I_0 = 2 pi lambda^2 (1 - lambda^2 / 3 + lambda^4 / 15 - ...), MODEL 8.2;
// the next term is below lambda^6 / 50.
TEST(KernelSpectrum, MeanIsTheSeriesOfTheModel)
{
  const double width = 0.1, square = width * width;
  const double mean = 2. * std::numbers::pi * square *
                      (1. - square / 3. + square * square / 15.);
  EXPECT_NEAR(kernel_spectrum(width, 0)[0], mean, 1e-7 * mean);
}

TEST(KernelWidth, IsThePatchWithAFloorAndALimit)
{
  Spall spall = spall_at(Vec3::UnitX());
  const double patch = std::sqrt(spall.overlap * 0.005) / 0.01;
  EXPECT_NEAR(kernel_width(spall, 0.01, 20, {0.5}), patch, 1e-15);
  EXPECT_DOUBLE_EQ(kernel_width(spall, 0.01, 20, {2.5}), 0.125);
  EXPECT_DOUBLE_EQ(kernel_width(spall, 0.01, 8, {2.5}), 0.3125);
  EXPECT_DOUBLE_EQ(kernel_width(spall, 0.01, 2, {2.5}),
                   0.25 * std::numbers::pi);
}

// The difference of two volumes of about 4e-6 m^3 carries 1e-16 of them, V_i
// is 1e-10 m^3 and more.
TEST(ApplySpall, RemovesExactlyTheVolume)
{
  for (const double overlap : {5e-5, 1e-4, 1e-3})
    for (const Vec3 &u : random_directions(5, 1))
    {
      const Body body = stone(1);
      const Spall spall = spall_at(u, overlap);
      const SpallResult result = apply_spall(body, spall, {kernel_floor});
      ASSERT_TRUE(result.is_accepted);
      EXPECT_NEAR(result.removed_volume, spall.volume, 1e-9 * spall.volume);
      EXPECT_NEAR(body.volume - result.body.volume, spall.volume,
                  1e-9 * spall.volume);
      EXPECT_GT(result.depth, 0.);
    }
}

TEST(ApplySpall, TakesThetaTimesKernelFromTheSeries)
{
  const Body body = stone(2);
  const Vec3 u = random_directions(1, 2)[0];
  const SpallResult result = apply_spall(body, spall_at(u), {kernel_floor});
  const std::vector<double> spectrum = kernel_spectrum(result.width, 20);
  const Coefficients before = scaled_coefficients(body);
  const Coefficients after = scaled_coefficients(result.body);
  std::vector<double> y(after.size());
  evaluate_harmonics(20, u, y);
  for (int n = 0; n <= 20; ++n)
    for (int m = -n; m <= n; ++m)
    {
      const auto j = std::size_t(harmonic_index(n, m));
      EXPECT_NEAR(before[j] - after[j],
                  result.depth * spectrum[std::size_t(n)] * y[j],
                  1e-12 * result.depth);
    }
}

// A sphere to first order: theta I_0 r^2 = V_i (MODEL 8.2); the second order
// is theta / 2 r ~ 1e-4 and the truncation of the kernel conserves its mean.
TEST(ApplySpall, DepthOnASphereIsTheClosedForm)
{
  const double r = 0.02;
  const Body body = own_body(sphere_series(20, r));
  Spall spall = spall_at(Vec3::UnitY(), 1e-5);
  const SpallResult result = apply_spall(body, spall, {kernel_floor});
  const double mean = kernel_spectrum(result.width, 0)[0];
  EXPECT_NEAR(result.depth, spall.volume / (r * r * mean), 1e-4 * result.depth);
  // theta / delta = 1 / (2 s^2) where the patch rules the width
  spall.overlap = 0.0005;
  spall.gaussian_curvature = 1. / (r * r);
  spall.volume = cap_of(spall.overlap, spall.gaussian_curvature).volume;
  EXPECT_NEAR(apply_spall(body, spall, {kernel_floor}).depth / spall.overlap,
              0.5,
              0.01); // lambda^2 / 3 and theta / 2 r, 0.9 % each at most
}

TEST(ApplySpall, CopiesTheSeriesOnFirstBreakOnly)
{
  const auto shared = std::make_shared<const Coefficients>(random_stone(20, 3));
  const Coefficients kept = *shared;
  const Body first = make_body(shared, 0.01), second = make_body(shared, 0.02);
  const SpallResult result =
      apply_spall(first, spall_at(Vec3::UnitZ()), {kernel_floor});
  ASSERT_TRUE(result.is_accepted);
  EXPECT_NE(result.body.series, shared);
  EXPECT_EQ(result.body.scale, 1.);
  EXPECT_EQ(second.series, shared);
  EXPECT_EQ(*shared, kept);
  const Coefficients once = *result.body.series;
  const SpallResult again =
      apply_spall(result.body, spall_at(Vec3::UnitX()), {kernel_floor});
  ASSERT_TRUE(again.is_accepted);
  EXPECT_EQ(*result.body.series, once);
}

TEST(ApplySpall, BluntsTheCornerAndKeepsTheOtherSide)
{
  const Body body = stone(4);
  const Vec3 u = random_directions(1, 4)[0];
  const SpallResult result = apply_spall(body, spall_at(u), {kernel_floor});
  const Coefficients before = scaled_coefficients(body);
  const Coefficients &after = *result.body.series;
  EXPECT_NEAR(radius(before, u) - radius(after, u), result.depth,
              0.04 * result.depth); // the peak of the truncated kernel, 8.4
  // the truncated kernel rings, most of all at the far pole
  EXPECT_NEAR(radius(before, -u), radius(after, -u), 0.01 * result.depth);
  EXPECT_LT(mean_radius(result.body), mean_radius(body));
}

TEST(ApplySpall, RefusesMoreThanTheStoneCanGive)
{
  const Body body = stone(5);
  Spall spall = spall_at(Vec3::UnitX());
  spall.volume = 0.9 * body.volume;
  const SpallResult result = apply_spall(body, spall, {kernel_floor});
  EXPECT_FALSE(result.is_accepted);
  EXPECT_EQ(result.body.series, body.series);
  EXPECT_EQ(result.body.volume, body.volume);
  EXPECT_EQ(result.removed_volume, 0.);
  EXPECT_FALSE(
      apply_spall(make_sphere(0.01), spall_at(Vec3::UnitX()), {kernel_floor})
          .is_accepted);
}
