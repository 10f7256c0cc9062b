#include "../shape/test_shapes.h"

#include <dem/breakage/update.h>
#include <dem/contact/side.h>
#include <dem/shape/measures.h>

#include <gtest/gtest.h>

using namespace dem;
using namespace dem::test;

namespace
{
constexpr double kernel_floor = 2.5;

ParticleShape particle(unsigned seed)
{
  return make_shape(
      std::make_shared<const Coefficients>(random_particle(20, seed)), 0.01);
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

// I_0 = 2 pi lambda^2 (1 - lambda^2 / 3 + lambda^4 / 15 - ...);
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
      const ParticleShape body = particle(1);
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
  const ParticleShape body = particle(2);
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

// A sphere to first order: theta I_0 r^2 = V_i; the second order
// is theta / 2 r ~ 1e-4 and the truncation of the kernel conserves its mean.
TEST(ApplySpall, DepthOnASphereIsTheClosedForm)
{
  const double r = 0.02;
  const ParticleShape body = shape_of(sphere_series(20, r));
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
  const auto shared =
      std::make_shared<const Coefficients>(random_particle(20, 3));
  const Coefficients kept = *shared;
  const ParticleShape first = make_shape(shared, 0.01),
                      second = make_shape(shared, 0.02);
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
  const ParticleShape body = particle(4);
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

TEST(ApplySpall, RefusesMoreThanTheParticleCanGive)
{
  const ParticleShape body = particle(5);
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

TEST(KernelWidth, ScalesThePatch)
{
  const Spall spall = spall_at(Vec3::UnitX());
  EXPECT_DOUBLE_EQ(kernel_width(spall, 0.01, 20, {0.5, 2.}),
                   2. * kernel_width(spall, 0.01, 20, {0.5, 1.}));
}

// Eqs. 17, 18: r_0^3 falls by 3 V_i / 4 pi; all other coefficients by theta k_n
// Y_nm with theta = V_i / (r_0^2 int K). On a sphere that is the exact closure
// to first order (theta / 2 r = 1e-4); elsewhere the volume is another one, and
// what is booked is what has gone.
TEST(ApplySpall, ClosureOfTheArticle)
{
  const KernelRule rule{2.5, 1., DepthClosure::article};
  const ParticleShape ball = shape_of(sphere_series(20, 0.02));
  const Spall spall = spall_at(Vec3::UnitY(), 1e-5);
  const SpallResult on_ball = apply_spall(ball, spall, rule);
  ASSERT_TRUE(on_ball.is_accepted);
  EXPECT_NEAR(on_ball.removed_volume, spall.volume, 1e-3 * spall.volume);
  EXPECT_NEAR(std::pow(mean_radius(on_ball.body), 3),
              std::pow(0.02, 3) - 0.75 * spall.volume / std::numbers::pi,
              1e-14 * std::pow(0.02, 3));

  const ParticleShape body = particle(4);
  const SpallResult result = apply_spall(body, spall_at(Vec3::UnitX()), rule);
  ASSERT_TRUE(result.is_accepted);
  EXPECT_DOUBLE_EQ(result.removed_volume, body.volume - result.body.volume);
  EXPECT_GT(
      std::abs(result.removed_volume / spall_at(Vec3::UnitX()).volume - 1.),
      0.01);
}

namespace
{
/// Overlap of a sphere of the same K_G, pressed by a force against one like it
/// (G 0.5 GPa, nu 0.25) [m].
double overlap_at(double force, double gauss)
{
  const double radius = 0.5 / std::sqrt(gauss);
  return std::pow(force / (4. / 3. * 5e8 / 0.75 * std::sqrt(radius)), 2. / 3.);
}
} // namespace

// A particle that is pressed here and there by up to 12 N, in the end 24 N, and
// breaks where that is above 3 pi R G_c (200 J/m^2), until there have been ten
// thousand events. What is booked is what is gone (sums of 1e-16 of the
// volume), the volume falls every time, and the particle gets rounder.
TEST(ApplySpall, TenThousandEventsOnOneParticle)
{
  std::mt19937 generator(3);
  std::uniform_real_distribution<double> share(0., 1.);
  ParticleShape body = particle(6);
  const auto roundness_now = [&]
  { return roundness(scaled_coefficients(body), standard_quadrature()); };
  const double start = body.volume;
  double last = roundness_now();
  double booked = 0.;
  int n_events = 0;
  for (const Vec3 &u : random_directions(400000, 8))
  {
    const SideCurvature side = evaluate_side(body, u, 10.).curvature;
    const double gauss = side.gaussian();
    const double f = share(generator) * (12. + 1.2e-3 * n_events);
    if (!side.is_corner || f < 3. * std::numbers::pi * 2e2 / std::sqrt(gauss))
      continue;
    const double overlap = overlap_at(f, gauss);
    const SpallResult event = apply_spall(
        body, {u, cap_of(overlap, gauss).volume, overlap, gauss}, {});
    ASSERT_TRUE(event.is_accepted);
    ASSERT_TRUE(std::isfinite(event.body.volume));
    ASSERT_GT(event.body.inscribed_radius, 0.);
    ASSERT_LT(event.body.volume, body.volume);
    booked += event.removed_volume;
    body = event.body;
    if (++n_events == 10000)
      break;
    if (n_events % 2000 == 0)
    {
      const double now = roundness_now();
      EXPECT_GT(now, last) << n_events;
      last = now;
    }
  }
  EXPECT_EQ(n_events, 10000);
  EXPECT_GT(booked, 0.05 * start);
  EXPECT_NEAR(body.volume, start - booked, 1e-12 * start);
  EXPECT_GT(roundness_now(), last);
}
