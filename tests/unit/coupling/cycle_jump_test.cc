#include <coupling/cycle_jump.h>

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <optional>

// Jumps over load cycles, with formulas in place of a specimen.
namespace
{
using coupling::JumpPlan;
using coupling::JumpStep;
using coupling::PowerLaw;
using coupling::SlowState;

TEST(PowerLaw, IntegratesPowers)
{
  for (const double power : {-1.5, -1., -0.4, 0., 0.3})
  {
    const auto rate = [power](double x) { return 3. * std::pow(x, power); };
    const auto integral = [power](double x)
    {
      return power == -1. ? 3. * std::log(x)
                          : 3. / (power + 1.) * std::pow(x, power + 1.);
    };
    const PowerLaw law{12., rate(12.), 70., rate(70.)};
    const double exact = integral(60.) - integral(15.);
    EXPECT_NEAR(law.gain(15., 60.), exact, 1e-9 * exact) << power;
  }
}

TEST(PowerLaw, IsAStraightLineThroughARateThatIsNotPositive)
{
  const PowerLaw law{10., 2., 30., -2.};
  EXPECT_NEAR(law.gain(10., 20.), 10., 1e-12); // from 2 to 0
  EXPECT_NEAR(law.gain(10., 30.), 0., 1e-12);
}

/// A specimen whose slow variables follow formulas of the cycle.
struct Specimen
{
  std::function<double(double)> strain, abrasion;
  int calm = 0; ///< cycles after wear in which abrasion is half of its law
  double strain_now = 0., abrasion_now = 0.;
  int still_calm = 0;

  double growth(const std::function<double(double)> &law, double cycle) const
  {
    return law(cycle) - law(cycle - 1.);
  }
  void simulate(double cycle, double repetitions)
  {
    const bool wears = repetitions > 1.;
    strain_now += growth(strain, cycle);
    abrasion_now += repetitions * growth(abrasion, cycle) *
                    (still_calm > 0 && !wears ? 0.5 : 1.);
    still_calm = wears ? calm : still_calm - 1;
  }
};

struct Outcome
{
  Specimen specimen;
  JumpPlan plan;
  int n_simulated = 0;
};

/// As Triaxial and its recorder do it.
Outcome run(const coupling::CycleJumpParameters &parameters, Specimen specimen,
            int n_cycles)
{
  JumpPlan plan(parameters, n_cycles);
  std::optional<std::pair<JumpPlan, Specimen>> kept;
  double kept_cycle = 0., cycle = 0.;
  int n_simulated = 0;
  while (cycle < n_cycles || plan.due() == JumpStep::restore_state)
  {
    if (plan.due() == JumpStep::restore_state)
    {
      const JumpPlan refused = plan;
      std::tie(plan, specimen) = *kept;
      cycle = kept_cycle;
      plan.shorten(refused);
    }
    if (plan.due() == JumpStep::save_state)
    {
      kept = {plan, specimen};
      kept_cycle = cycle;
    }
    if (plan.due() != JumpStep::none)
      plan.begin();
    EXPECT_LE(plan.skipping(), 4);
    cycle += plan.skipping();
    if (plan.is_landing())
      specimen.strain_now += plan.missing_strain();
    specimen.simulate(++cycle, plan.repetitions());
    ++n_simulated;
    plan.take({cycle, specimen.strain_now, specimen.abrasion_now});
  }
  EXPECT_EQ(cycle, n_cycles);
  return {specimen, plan, n_simulated};
}

coupling::CycleJumpParameters tolerance(double value)
{
  coupling::CycleJumpParameters parameters;
  parameters.tolerance = value;
  return parameters;
}

Specimen shakedown()
{
  return {[](double cycle) { return 0.01 * std::pow(cycle, 0.3); },
          [](double cycle) { return 0.02 * std::pow(cycle, 0.7); }};
}

TEST(CycleJump, IsOffByDefault)
{
  const Outcome end = run({}, shakedown(), 50);
  EXPECT_EQ(end.n_simulated, 50);
  EXPECT_EQ(end.plan.account().n_jumps, 0);
}

TEST(CycleJump, FewestCyclesAreThoseOfEvenGrowth)
{
  const Specimen even = {[](double cycle) { return 1e-4 * cycle; },
                         [](double cycle) { return 1e-3 * cycle; }};
  for (const int n : {30, 300, 1000})
    EXPECT_EQ(coupling::least_cycles(tolerance(0.05), n),
              run(tolerance(0.05), even, n).n_simulated);
  EXPECT_EQ(coupling::least_cycles({}, 50), 50);
  // At most 50 in a jump, for which thirteen cycles stand; each jump with a
  // landing and eleven more.
  EXPECT_LT(coupling::least_cycles(tolerance(0.05), 1000), 380);
}

TEST(CycleJump, ThousandCyclesWithinTheTolerance)
{
  const Outcome end = run(tolerance(0.05), shakedown(), 1000);
  const double strain = 0.01 * std::pow(1000., 0.3),
               abrasion = 0.02 * std::pow(1000., 0.7);
  EXPECT_NEAR(end.specimen.strain_now, strain, 0.05 * strain);
  EXPECT_NEAR(end.specimen.abrasion_now, abrasion, 0.05 * abrasion);
  EXPECT_LT(end.n_simulated, 380);
  EXPECT_EQ(end.plan.account().n_skipped + end.n_simulated, 1000);
}

// Growth that sets in again after 300 cycles: seen by the cycles after a jump.
TEST(CycleJump, GoesBackWhereTheGrowthHasChanged)
{
  const auto strain = [](double cycle)
  { return 0.01 * std::log1p(cycle) + 2e-4 * std::max(0., cycle - 300.); };
  coupling::CycleJumpParameters parameters = tolerance(0.02);
  parameters.longest = 200;
  const Outcome end =
      run(parameters, {strain, [](double cycle) { return 1e-3 * cycle; }}, 600);
  EXPECT_GT(end.plan.account().n_refused, 0);
  EXPECT_NEAR(end.specimen.strain_now, strain(600.), 0.03 * strain(600.));
  EXPECT_LT(end.n_simulated, 400);
}

// Every second cycle grows, the other shrinks: no two rates agree.
TEST(CycleJump, SimulatesWhatCannotBePredicted)
{
  coupling::CycleJumpParameters parameters = tolerance(1e-3);
  parameters.observed = 3;
  const auto strain = [](double cycle)
  { return 0.01 + 5e-4 * std::fmod(cycle * cycle, 7.); };
  const Outcome end = run(parameters, {strain, [](double) { return 0.; }}, 100);
  EXPECT_GT(end.plan.account().n_refused, 0);
  EXPECT_GT(end.n_simulated, 80);
}

// Corners that have just broken bear less for six cycles: where growth is
// observed at once, every jump takes over too little from the one before.
TEST(CycleJump, WaitsForWhatHasJustBroken)
{
  const auto law = [](double cycle) { return 1e-3 * cycle; };
  const auto abrasion_after = [&law](int settled)
  {
    coupling::CycleJumpParameters parameters = tolerance(0.1);
    parameters.settled = settled;
    Specimen even{law, law};
    even.calm = 6;
    return run(parameters, even, 300).specimen.abrasion_now;
  };
  EXPECT_NEAR(abrasion_after(7), 0.3, 0.03 * 0.3);
  EXPECT_LT(abrasion_after(0), 0.9 * 0.3);
}
} // namespace
