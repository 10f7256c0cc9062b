#include "gain_scene.h"

#include <coupling/gain.h>

#include <gtest/gtest.h>

// A light plate pressed on a heavy particle, k dt^2 / (4 m) from 0.01 to 10:
// where each way of exchange fails and where it carries on is known.
using namespace support::gain;

TEST(ExchangeGain, EveryStepHoldsUpToOne)
{
  for (const double gain : {0.01, 0.1, 0.99})
    EXPECT_LT(swing(gain, {}).growth, 1.01) << gain;
  for (const double gain : {1.01, 3.})
    EXPECT_GT(swing(gain, {}).growth, 2.) << gain;
}

// z^2 (z - 1)^2 + g (1 + z)(4 z^2 - 3 z + 1) has z = i at g = 1/3.
TEST(ExchangeGain, OnePassHoldsUpToAThird)
{
  for (const int n : {1, 2, 10})
  {
    for (const double gain : {0.01, 0.1, 0.33})
      EXPECT_LT(swing(gain, one_pass(n)).growth, 1.) << gain << ' ' << n;
    for (const double gain : {0.3367, 1., 10.})
      EXPECT_GT(swing(gain, one_pass(n)).growth, 1.01) << gain << ' ' << n;
  }
}

// Each pass multiplies the error by -g.
TEST(ExchangeGain, PassesWithoutRelaxationConvergeBelowOne)
{
  using coupling::RelaxationKind;
  for (const double gain : {0.01, 0.3, 0.9})
    EXPECT_LT(swing(gain, iterated(RelaxationKind::constant, 1.), 300).growth,
              1.01)
        << gain;
  EXPECT_THROW(swing(1.01, iterated(RelaxationKind::constant, 1.), 300),
               std::runtime_error);
  // g^n = tolerance over the first error.
  const double slow =
      swing(0.9, iterated(RelaxationKind::constant, 1.), 300).passes;
  const double fast =
      swing(0.81, iterated(RelaxationKind::constant, 1.), 300).passes;
  EXPECT_NEAR(slow / fast, 2., 0.2);
}

// With the factor 1 / (1 + g) the linear problem is solved by two passes, and
// Aitken finds that factor.
TEST(ExchangeGain, IterationCarriesOnAtAnyGain)
{
  using coupling::RelaxationKind;
  for (const int n : {1, 10})
    for (const double gain : {0.01, 0.1, 1., 3., 10.})
    {
      const double best =
          coupling::window_gain({stiffness, 0.}, plate_mass,
                                2. * std::sqrt(gain * plate_mass / stiffness))
              .best_relaxation;
      EXPECT_NEAR(best, 1. / (1. + gain), 1e-12);
      const Outcome constant =
          swing(gain, iterated(RelaxationKind::constant, best, n), 300);
      // The particle moves by 1e-4 of it: a third pass, a fourth now and then.
      EXPECT_LE(constant.passes, 4.) << gain << ' ' << n;
      const Outcome aitken =
          swing(gain, iterated(RelaxationKind::aitken, 0.5, n), 300);
      EXPECT_LE(aitken.passes, 5.) << gain << ' ' << n;
      for (const Outcome &outcome : {constant, aitken})
      {
        EXPECT_LT(outcome.growth, 1.01) << gain << ' ' << n;
        EXPECT_LT(outcome.energy_error, 1e-7) << gain << ' ' << n;
      }
    }
}

// A quarter of a swing: the prediction is off by the change of the mean load,
// so that -T^2 / (2 m) sum f (f - 2 f' + f'') is lost: of third order.
TEST(ExchangeGain, LedgerOfOnePassIsOfThirdOrder)
{
  std::vector<double> energy_error;
  for (const double gain : {0.01, 0.0025, 0.000625})
  {
    const auto n = std::lround(0.25 * M_PI / std::sqrt(gain));
    energy_error.push_back(
        swing(gain, one_pass(4), static_cast<int>(n)).energy_error);
  }
  EXPECT_NEAR(energy_error[0] / energy_error[1], 8., 0.8);
  EXPECT_NEAR(energy_error[1] / energy_error[2], 8., 0.8);
}

// A dashpot lags too: the bound for one pass holds with it, and the sharp
// limits are met where they are sharp.
TEST(ExchangeGain, DashpotsCostGain)
{
  for (const double beta : {0.1, 0.3, 0.62, 1.})
  {
    const coupling::WindowGain limits =
        coupling::window_gain({stiffness, beta}, plate_mass, 1e-6);
    const double q = std::sqrt(limits.one_pass_limit);
    EXPECT_NEAR(3. * q * q + 8. * beta * q, 1., 1e-12);
    for (const int n : {1, 2, 20})
    {
      Way way = one_pass(n);
      way.damping = beta;
      EXPECT_LT(swing(0.98 * limits.one_pass_limit, way, 400).growth, 1.)
          << beta << ' ' << n;
    }
    Way way = iterated(coupling::RelaxationKind::constant, 1., 50);
    way.damping = beta;
    EXPECT_LT(swing(0.9 * limits.unrelaxed_limit, way, 50).growth, 1.) << beta;
    EXPECT_THROW(swing(1.2 * limits.unrelaxed_limit, way, 50),
                 std::runtime_error)
        << beta;
  }
}

TEST(Relaxation, EqualResidualsKeepTheFactor)
{
  coupling::Relaxation relaxation({coupling::RelaxationKind::aitken, 0.5});
  coupling::Field guess(1, dem::Vec3::Zero());
  const coupling::Field residual(1, dem::Vec3::UnitX());
  relaxation.correct(residual, guess);
  relaxation.correct(residual, guess);
  EXPECT_EQ(relaxation.factor(), 0.5);
  EXPECT_EQ(guess[0].x(), 1.);
  relaxation.correct({guess.data(), 1}, guess); // tiny change, huge factor
  EXPECT_LE(relaxation.factor(), 1.);
  EXPECT_GE(relaxation.factor(), 0.01);
}
