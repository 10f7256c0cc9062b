#include <dem/breakage/criterion.h>

#include <gtest/gtest.h>

#include <numbers>

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
  EXPECT_DOUBLE_EQ(damage_step(0.25, 2., 1., 4.).factor, 0.25);
  EXPECT_EQ(mode_of(damage_step(0.25, 1., 2., 4.)), BreakageMode::none);
}

TEST(DamageStep, ModesAreStrictAndTwoPrecedesOne)
{
  EXPECT_EQ(mode_of(damage_step(0.5, 1., 3., 4.)), BreakageMode::none);
  EXPECT_EQ(mode_of(damage_step(0.75, 1., 3., 4.)), BreakageMode::cumulative);
  EXPECT_EQ(mode_of(damage_step(0., 4., 4., 4.)), BreakageMode::none);
  EXPECT_EQ(mode_of(damage_step(0., 4., 4.1, 4.)), BreakageMode::instantaneous);
  EXPECT_EQ(mode_of(damage_step(5., 1., 4.1, 4.)), BreakageMode::instantaneous);
  EXPECT_EQ(mode_of(damage_step(5., 8., 3., 4.)), BreakageMode::cumulative);
}

TEST(FactorAfter, IsEquationSix)
{
  EXPECT_DOUBLE_EQ(factor_after(BreakageMode::none, 0.7), 0.7);
  EXPECT_DOUBLE_EQ(factor_after(BreakageMode::cumulative, 1.25), 0.25);
  EXPECT_DOUBLE_EQ(factor_after(BreakageMode::instantaneous, 1.25), 0.);
}
