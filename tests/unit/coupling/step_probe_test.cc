#include <coupling/step_probe.h>

#include <gtest/gtest.h>

#include <cmath>

namespace
{
constexpr double stable = 4e-6;
const coupling::ProbeScene scene{1e-4, stable, 0., 20};

/// One probe at `step` of a scheme whose force error is share (dt / stable)^2.
void probe(coupling::ProbeState &state, double step, double share)
{
  const double coarse = share * std::pow(step / stable, 2);
  state.coarse_step = step;
  state.coarse = {1. + coarse, 1., 0., 1., 0.};
  state.fine = {1. + 0.25 * coarse, 1., 0., 1., 0.};
}

/// Where the step settles.
double settled(double share, double tolerance)
{
  coupling::StepTolerances tolerances;
  tolerances.force = tolerance;
  coupling::ProbeState state;
  double step = stable;
  for (int n = 0; n < 400; ++n)
  {
    probe(state, step, share);
    coupling::adapt(tolerances, scene, state);
    step = state.longest;
  }
  return step;
}
} // namespace

// Second order: 0.9^2 of the tolerance is the aim.
TEST(StepProbe, HoldsTheForceError)
{
  const double step = settled(0.04, 0.01);
  const double error = 0.04 * std::pow(step / stable, 2);
  EXPECT_NEAR(error, 0.81 * 0.01, 0.02 * 0.01);
}

TEST(StepProbe, NeverAboveTheStableStepNorBelowATwentieth)
{
  EXPECT_EQ(settled(1e-6, 0.01), stable);
  EXPECT_EQ(settled(1e3, 0.01), 0.05 * stable);
}

// The estimate is that of the coarse run: 4/3 of the difference.
TEST(StepProbe, EstimatesTheErrorOfTheCoarseRun)
{
  coupling::ProbeState state;
  probe(state, stable, 1e-3);
  state.coarse.residual = 0.002;
  coupling::adapt({}, scene, state);
  EXPECT_NEAR(coupling::errors_of(state).force, 1e-3,
              1e-6); // second order of it
  EXPECT_NEAR(coupling::errors_of(state).energy, 4. / 3. * 0.002, 1e-15);
  EXPECT_EQ(state.n_probes, 1);
}

// Residuals of both signs cancel over a cycle, as they do in the ledger.
TEST(StepProbe, EnergyErrorIsSigned)
{
  coupling::ProbeState state;
  for (int n = 0; n < 20; ++n)
  {
    probe(state, stable, 0.);
    state.coarse.residual = n % 2 == 0 ? 1e-3 : -1e-3;
    coupling::adapt({}, scene, state);
  }
  EXPECT_NEAR(coupling::errors_of(state).energy, 0., 1e-12);
}

// Where the load turns there is hardly any work: the stored energy counts.
TEST(StepProbe, StoredEnergyIsTheLeastScale)
{
  coupling::ProbeState state;
  probe(state, stable, 0.);
  state.coarse.work = 0.;
  state.coarse.residual = 1e-7;
  coupling::ProbeScene turning = scene;
  turning.stored_power = 1.;
  coupling::adapt({}, turning, state);
  EXPECT_NEAR(coupling::errors_of(state).energy, 4. / 3. * 1e-3, 1e-12);
}

// One outlier shortens the step once, not again and again.
TEST(StepProbe, OutlierIsCarriedOver)
{
  coupling::ProbeState state;
  probe(state, stable, 0.04);
  coupling::adapt({}, scene, state);
  const double after = state.longest;
  EXPECT_LT(after, 0.6 * stable);
  for (int n = 0; n < 5; ++n)
  {
    probe(state, state.longest, 0.);
    coupling::adapt({}, scene, state);
  }
  EXPECT_GT(state.longest, 0.9 * after);
}
