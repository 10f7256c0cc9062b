#include <dem/breakage/criterion.h>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

using namespace dem;

// Closed forms of the energy criterion for Hertz contacts: E_e / E_b =
// F / (5 pi R G_c) and l = F / (3 pi R G_c), R = 1 / sqrt(K_G), whatever the
// modulus. MODEL 6.1; the energy is 2/5 F delta.
namespace
{
constexpr double pi = std::numbers::pi;
constexpr double fracture_energy = 1e4; ///< G_c [J/m^2]
constexpr double corner_radius = 0.003; ///< R [m]
constexpr double stiffness = 3e8;       ///< C_H of F = C_H delta^(3/2)

double force(double overlap)
{
  return stiffness * std::pow(overlap, 1.5);
}

double energy(double overlap)
{
  return 0.4 * force(overlap) * overlap;
}

double breakage_energy(double overlap)
{
  return fracture_energy *
         cap_of(overlap, 1. / (corner_radius * corner_radius)).area;
}

double overlap_at(double f)
{
  return std::pow(f / stiffness, 2. / 3.);
}

/// Cumulative factor when the overlap grows from `start` to `end` in steps.
double load(double start, double end, int n_steps)
{
  double factor = 0.;
  for (int i = 1; i <= n_steps; ++i)
  {
    const double before = start + (end - start) * (i - 1) / n_steps;
    const double now = start + (end - start) * i / n_steps;
    factor =
        damage_step(factor, energy(before), energy(now), breakage_energy(now))
            .factor;
  }
  return factor;
}
} // namespace

TEST(BreakageClosedForms, InstantaneousModeStartsAtFivePiRG)
{
  const double threshold = 5. * pi * corner_radius * fracture_energy;
  for (const double share : {0.999, 1.001})
  {
    const double overlap = overlap_at(share * threshold);
    EXPECT_NEAR(energy(overlap) / breakage_energy(overlap), share, 1e-12);
    // energy before equals energy now: nothing accumulates
    const DamageStep<double> step = damage_step(
        0., energy(overlap), energy(overlap), breakage_energy(overlap));
    EXPECT_EQ(mode_of(step),
              share > 1. ? BreakageMode::instantaneous : BreakageMode::none);
  }
}

// The sum is a right-hand rule of int dE / A: error of order 1 / n.
TEST(BreakageClosedForms, CumulativeFactorIsForceOverThreePiRG)
{
  const double f = 80.;
  const double exact = f / (3. * pi * corner_radius * fracture_energy);
  EXPECT_NEAR(load(0., overlap_at(f), 200000), exact, 2e-5 * exact);
}

TEST(BreakageClosedForms, CumulativeFactorOfACycleIsItsForceSwing)
{
  const double low = 40., high = 100.;
  const double exact =
      (high - low) / (3. * pi * corner_radius * fracture_energy);
  EXPECT_NEAR(load(overlap_at(low), overlap_at(high), 100000), exact,
              2e-5 * exact);
}

// First event at F = 3 pi R G_c, in mode I.
TEST(BreakageClosedForms, SlowLoadingBreaksInModeOneFirst)
{
  const double threshold = 3. * pi * corner_radius * fracture_energy;
  const int n_steps = 100000;
  const double end = overlap_at(1.2 * threshold);
  double factor = 0.;
  for (int i = 1; i <= n_steps; ++i)
  {
    const double before = end * (i - 1) / n_steps, now = end * i / n_steps;
    const DamageStep<double> step =
        damage_step(factor, energy(before), energy(now), breakage_energy(now));
    factor = step.factor;
    if (mode_of(step) == BreakageMode::none)
      continue;
    EXPECT_EQ(mode_of(step), BreakageMode::cumulative);
    EXPECT_NEAR(force(now), threshold, 1e-4 * threshold);
    EXPECT_NEAR(factor_after(mode_of(step), factor), 0., 1e-4);
    return;
  }
  FAIL() << "no event";
}

// In units of F / (5 pi R G_c), by the number of equal steps (own values of
// the sum, MODEL 6.1).
TEST(BreakageClosedForms, CumulativeFactorDependsOnTheStep)
{
  const double f = 80.;
  const double unit = f / (5. * pi * corner_radius * fracture_energy);
  const double end = overlap_at(f);
  EXPECT_NEAR(load(0., end, 1) / unit, 1., 1e-12);
  EXPECT_NEAR(load(0., end, 2) / unit, 1.176776695296637, 1e-12);
  EXPECT_NEAR(load(0., end, 3) / unit, 1.2776687295155433, 1e-12);
  EXPECT_NEAR(load(0., end, 5) / unit, 1.3883466147673618, 1e-12);
  EXPECT_NEAR(load(0., end, 10) / unit, 1.5007147160422685, 1e-12);
}
