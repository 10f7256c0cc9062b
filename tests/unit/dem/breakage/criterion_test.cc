#include <dem/breakage/criterion.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>
#include <utility>
#include <vector>

using namespace dem;

TEST(Cap, IsTheParaboloidOfTheModel)
{
  // base of a sphere's cap 2 pi R delta, volume half base times height
  const double r = 0.005, overlap = 1e-4;
  const Cap cap = cap_of(overlap, 1. / (r * r));
  const double area = 2. * std::numbers::pi * r * overlap;
  EXPECT_NEAR(cap.area, area, 1e-14 * area);
  EXPECT_NEAR(cap.volume, 0.5 * area * overlap, 1e-14 * area * overlap);
}

TEST(DamageStep, AddsOnlyWhatTheEnergyGains)
{
  EXPECT_DOUBLE_EQ(damage_step(0.25, 1., 2., 4.).factor, 0.5);
  EXPECT_DOUBLE_EQ(damage_step(0.25, -1., 1., 4.).factor, 0.25);
  EXPECT_EQ(mode_of(damage_step(0.25, 1., 2., 4.)), BreakageMode::none);
}

TEST(DamageStep, ModesAreStrictAndTwoPrecedesOne)
{
  EXPECT_EQ(mode_of(damage_step(0.5, 2., 3., 4.)), BreakageMode::none);
  EXPECT_EQ(mode_of(damage_step(0.75, 2., 3., 4.)), BreakageMode::cumulative);
  EXPECT_EQ(mode_of(damage_step(0., 0., 4., 4.)), BreakageMode::none);
  EXPECT_EQ(mode_of(damage_step(0., 0.1, 4.1, 4.)),
            BreakageMode::instantaneous);
  EXPECT_EQ(mode_of(damage_step(5., 3.1, 4.1, 4.)),
            BreakageMode::instantaneous);
  EXPECT_EQ(mode_of(damage_step(5., -5., 3., 4.)), BreakageMode::cumulative);
}

TEST(FactorAfter, IsEquationSix)
{
  EXPECT_DOUBLE_EQ(factor_after(BreakageMode::none, 0.7), 0.7);
  EXPECT_DOUBLE_EQ(factor_after(BreakageMode::cumulative, 1.25), 0.25);
  EXPECT_DOUBLE_EQ(factor_after(BreakageMode::instantaneous, 1.25), 0.);
}

TEST(DamageStep, PrecedenceIsAChoice)
{
  const DamageStep<double> both{1.5, 1.1}, second{0.5, 1.1};
  EXPECT_EQ(mode_of(both), BreakageMode::instantaneous);
  EXPECT_EQ(mode_of(both, ModePrecedence::cumulative),
            BreakageMode::cumulative);
  EXPECT_EQ(mode_of(second, ModePrecedence::cumulative),
            BreakageMode::instantaneous);
}

namespace
{
/// Sum of what counts of a sequence of energies.
double counted(double reversal, const std::vector<double> &energies,
               double band)
{
  double sum = 0.;
  for (const double energy : energies)
  {
    const double before =
        std::exchange(reversal, reversal_of_energy(reversal, energy, band));
    sum += std::max(0., counted_rise(before, reversal));
  }
  return sum;
}
} // namespace

TEST(CountEnergy, PassesSwingsWithinTheBand)
{
  EXPECT_EQ(counted(1., {0.95, 0.91, 1., 0.92, 0.99}, 0.1), 0.);
  // Fallen, but not up again by more than the band.
  EXPECT_EQ(counted(1., {0.5, 0.55, 0.46, 0.5}, 0.1), 0.);
}

TEST(CountEnergy, CountsLargerSwingsInFull)
{
  EXPECT_DOUBLE_EQ(counted(1., {0.5, 2.}, 0.1), 1.5);
  EXPECT_DOUBLE_EQ(counted(1., {0.8, 0.5, 0.52, 0.7, 1., 2.}, 0.1), 1.5);
  EXPECT_DOUBLE_EQ(counted(1., {0.95, 2.}, 0.1), 1.); // no swing: a rise
  EXPECT_DOUBLE_EQ(counted(0., {0.1, 0.3}, 0.1), 0.3);
  EXPECT_DOUBLE_EQ(counted(1., {0., 0., 0.3, 0., 0.2}, 0.1), 0.5); // opened
}

TEST(CountEnergy, WithoutBandEveryRiseCounts)
{
  const std::vector<double> energies = {0.3, 0.31, 0.2, 0., 1., 4., 3.9, 3.95};
  double rises = 0., before = 1.;
  for (const double energy : energies)
  {
    rises += std::max(0., energy - before);
    before = energy;
  }
  EXPECT_DOUBLE_EQ(counted(1., energies, 0.), rises);
}

// What is rounded off the reversal in one step counts in the next.
TEST(CountEnergy, KeepsSlowRisesThoughReversalsAreRounded)
{
  constexpr int n_steps = 1'000'000;
  float reversal = 1.f;
  double sum = 0.;
  for (int i = 1; i <= n_steps; ++i)
  {
    const double before = reversal, energy = 1. + 1e-3 * i / n_steps;
    reversal = static_cast<float>(reversal_of_energy(before, energy, 0.01));
    sum += counted_rise<double>(before, reversal);
  }
  EXPECT_NEAR(sum, 1e-3, 1e-7);
}

TEST(BreakageParameters, OnlySomeChoicesNeedAReversal)
{
  BreakageParameters p;
  EXPECT_TRUE(p.needs_reversal());
  p.hysteresis = 0.;
  EXPECT_FALSE(p.needs_reversal());
  p.energy = CriterionEnergy::with_shear;
  EXPECT_TRUE(p.needs_reversal());
}
