#include <dem/measure/hysteresis.h>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace
{
constexpr double amplitude = 50e3, strain_amplitude = 1e-3; // Pa, -

/// A cycle of q = q_a (1 - cos wt), eps = eps_a (1 - cos(wt - lag)).
dem::Hysteresis cycle(double lag, int n)
{
  dem::Hysteresis loop;
  for (int k = 0; k <= n; ++k)
  {
    const double phase = 2. * std::numbers::pi * k / n;
    const double strain = strain_amplitude * (1. - std::cos(phase - lag)),
                 stress = amplitude * (1. - std::cos(phase));
    if (k == 0)
      loop.begin(strain, stress);
    else
      loop.add(strain, stress);
  }
  return loop;
}
} // namespace

// Linear and viscous: area pi q_a eps_a sin(lag), W_s = q_a eps_a
// (1 + cos(lag)) / 4, so the ratio is tan(lag / 2). It is
// unloaded where the cycle ends.
TEST(Hysteresis, OfALaggingStrainHasItsDampingRatio)
{
  for (const double lag : {0.05, 0.3, 1.})
  {
    const dem::Hysteresis fine = cycle(lag, 2000);
    EXPECT_NEAR(fine.damping_ratio(), std::tan(0.5 * lag),
                1e-5 * std::tan(0.5 * lag));
    // A polygon of n corners lacks (2 pi / n)^2 / 6 of the ellipse.
    const double lacking = std::pow(2. * std::numbers::pi / 50, 2) / 6.;
    EXPECT_NEAR(cycle(lag, 50).damping_ratio(),
                std::tan(0.5 * lag) * (1. - lacking),
                1e-3 * std::tan(0.5 * lag));
  }
}

TEST(Hysteresis, OfASpringHasItsModulus)
{
  const dem::Hysteresis loop = cycle(0., 40);
  EXPECT_DOUBLE_EQ(loop.resilient_strain(), 2. * strain_amplitude);
  EXPECT_DOUBLE_EQ(loop.cyclic_stress(), 2. * amplitude);
  EXPECT_DOUBLE_EQ(loop.resilient_modulus(), amplitude / strain_amplitude);
  EXPECT_NEAR(loop.damping_ratio(), 0., 1e-12);
}

// Plastic loading to (2 e, q), elastic unloading to (e, 0): a triangle of area
// q e / 2 over 4 pi q e / 8 is 1 / pi.
TEST(Hysteresis, OfAPlasticCycleCountsThePermanentStrain)
{
  dem::Hysteresis loop;
  loop.begin(0., 0.);
  loop.add(2e-3, 1e5);
  loop.add(1e-3, 0.);
  EXPECT_DOUBLE_EQ(loop.resilient_strain(), 1e-3);
  EXPECT_NEAR(loop.damping_ratio(), 1. / std::numbers::pi, 1e-14);
}

TEST(Hysteresis, WithoutMotionHasNoNumber)
{
  dem::Hysteresis loop;
  loop.begin(1e-3, 3.);
  EXPECT_TRUE(std::isnan(loop.resilient_modulus()));
  EXPECT_TRUE(std::isnan(loop.damping_ratio()));
}
