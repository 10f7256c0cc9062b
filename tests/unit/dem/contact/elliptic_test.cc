#include <dem/contact/elliptic.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <string>

namespace
{
const dem::Elasticity particle{.shear_modulus = 5e8, .poisson_ratio = 0.25};
const dem::Elasticity steel{.shear_modulus = 7.9e10, .poisson_ratio = 0.28};
const dem::Elasticity rigid{.is_rigid = true};

double cos_of_degrees(double angle)
{
  return std::cos(angle * std::numbers::pi / 180.);
}

std::string message_of(const dem::Elasticity &a, const dem::Elasticity &b)
{
  try
  {
    dem::mix(a, b);
  }
  catch (const std::invalid_argument &error)
  {
    return error.what();
  }
  return "";
}
} // namespace

TEST(EllipticMix, SumsOverBothBodies)
{
  const dem::PairElasticity pair = dem::mix(particle, steel);
  // Round-off only.
  EXPECT_NEAR(pair.modulus, 1. / (0.375 / 5e8 + 0.36 / 7.9e10), 1e-6);
  EXPECT_DOUBLE_EQ(pair.compliance, 1. / 5e8 + 1. / 7.9e10);
  EXPECT_DOUBLE_EQ(pair.cross_compliance, 0.25 / 5e8 + 0.28 / 7.9e10);
  EXPECT_DOUBLE_EQ(dem::mix(steel, particle).modulus, pair.modulus);
}

TEST(EllipticMix, RigidBodyContributesNothing)
{
  const dem::PairElasticity pair = dem::mix(particle, rigid);
  EXPECT_DOUBLE_EQ(pair.modulus, 4. / 3. * 1e9);
  EXPECT_DOUBLE_EQ(pair.compliance, 2e-9);
  EXPECT_DOUBLE_EQ(pair.cross_compliance, 5e-10);
}

TEST(EllipticMix, BadInputIsNamed)
{
  EXPECT_NE(message_of(rigid, rigid).find("both bodies"), std::string::npos);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const double modulus : {0., -5e8, nan})
    EXPECT_NE(message_of(particle, {.shear_modulus = modulus})
                  .find("a positive number is needed"),
              std::string::npos);
  for (const double ratio : {-1., 0.51, nan})
    EXPECT_NE(
        message_of({.shear_modulus = 1e8, .poisson_ratio = ratio}, particle)
            .find("at most 0.5 is allowed"),
        std::string::npos);
}

TEST(EllipticGap, SpheresAndCylinders)
{
  const dem::GapCoefficients spheres =
      dem::gap_coefficients({100., 100., 200., 200., 0.3});
  EXPECT_DOUBLE_EQ(spheres.a, 150.);
  EXPECT_DOUBLE_EQ(spheres.b, 150.);

  const dem::GapCoefficients cylinders =
      dem::gap_coefficients({100., 0., 100., 0., cos_of_degrees(90.)});
  // B = 50 (1 + cos 45 degrees), A = 50 (1 - cos 45 degrees); round-off.
  EXPECT_NEAR(cylinders.b, 50. * (1. + std::sqrt(0.5)), 1e-13 * 100.);
  EXPECT_NEAR(cylinders.a, 50. * (1. - std::sqrt(0.5)), 1e-13 * 100.);
}

TEST(EllipticGap, DoesNotDependOnTheOrderOfTheBodies)
{
  const dem::GapCoefficients ab =
      dem::gap_coefficients({800., 20., 600., 10., cos_of_degrees(60.)});
  const dem::GapCoefficients ba =
      dem::gap_coefficients({600., 10., 800., 20., cos_of_degrees(60.)});
  EXPECT_DOUBLE_EQ(ab.a, ba.a);
  EXPECT_DOUBLE_EQ(ab.b, ba.b);
}

// A = 50 (1 - cos psi) = 100 sin^2(psi / 2) is kept to round-off where the
// difference of A + B and B - A would lose nine digits.
TEST(EllipticGap, AlmostParallelCylindersKeepTheirDigits)
{
  const double angle = 1e-3; // cos(2 psi) itself keeps 1e-10 of 1 - cos
  const dem::GapCoefficients gap =
      dem::gap_coefficients({100., 0., 100., 0., std::cos(2. * angle)});
  const double exact = 100. * std::pow(std::sin(0.5 * angle), 2);
  EXPECT_NEAR(gap.a, exact, 1e-9 * exact);
}

TEST(EllipticGap, ParallelCylindersStayFinite)
{
  const dem::GapCoefficients gap =
      dem::gap_coefficients({100., 0., 100., 0., 1.});
  EXPECT_GT(gap.a, 0.);
  const dem::HertzPrefactors force =
      dem::elliptic_table()(dem::mix(particle, particle), gap);
  EXPECT_TRUE(std::isfinite(force.normal));
  EXPECT_TRUE(std::isfinite(force.tangential));
}

TEST(EllipticSolver, IntegralsAtTheEnds)
{
  const dem::PairElasticity pair = dem::mix(particle, particle);
  const dem::EllipticContact circle = dem::solve_elliptic(pair, {40., 40.});
  EXPECT_DOUBLE_EQ(circle.K, 0.5 * std::numbers::pi);
  EXPECT_DOUBLE_EQ(circle.E, 0.5 * std::numbers::pi);
  EXPECT_EQ(circle.eccentricity, 0.);
  EXPECT_EQ(circle.axis_ratio, 1.);
  // K -> ln(4 alpha), E -> 1 for a long ellipse, both with a remainder of
  // the order (ln alpha) / alpha^2 < 1e-5 at B / A = 1e4.
  const dem::EllipticContact slit = dem::solve_elliptic(pair, {1e-2, 100.});
  EXPECT_NEAR(slit.K, std::log(4. * slit.axis_ratio), 1e-4);
  EXPECT_NEAR(slit.E, 1., 1e-4);
}

// The worst of 2000 ratios is 2.4e-11; 1e-9 is the promise of the header.
TEST(EllipticTable, FollowsTheExactSolution)
{
  for (const dem::Elasticity &other : {particle, steel, rigid})
  {
    const dem::PairElasticity pair = dem::mix(particle, other);
    for (int k = 0; k <= 2000; ++k)
    {
      const double ratio = std::exp(k / 2000. * std::log(1e4));
      const dem::GapCoefficients gap{80., 80. * ratio};
      const dem::HertzPrefactors exact =
          dem::solve_elliptic(pair, gap).prefactors;
      const dem::HertzPrefactors fit = dem::elliptic_table()(pair, gap);
      ASSERT_NEAR(fit.normal, exact.normal, 1e-10 * exact.normal) << ratio;
      ASSERT_NEAR(fit.tangential, exact.tangential, 1e-10 * exact.tangential)
          << ratio;
    }
  }
}

TEST(EllipticTable, BeyondTheRangeIsTheEndOfTheRange)
{
  const dem::PairElasticity pair = dem::mix(particle, particle);
  const dem::EllipticTable &table = dem::elliptic_table();
  const dem::HertzPrefactors end = table(pair, {1e-2, 100.});
  const dem::HertzPrefactors beyond = table(pair, {1e-9, 100.});
  EXPECT_DOUBLE_EQ(beyond.normal, end.normal);
  EXPECT_DOUBLE_EQ(beyond.tangential, end.tangential);
}

// Scaling: curvatures times 4 halve C_H and k_s, moduli times 2 double them.
TEST(EllipticTable, ScalesAsTheEquationsSay)
{
  const dem::EllipticTable &table = dem::elliptic_table();
  const dem::HertzPrefactors base =
      table(dem::mix(particle, particle), {10., 70.});
  const dem::HertzPrefactors sharp =
      table(dem::mix(particle, particle), {40., 280.});
  const dem::Elasticity stiff{.shear_modulus = 1e9, .poisson_ratio = 0.25};
  const dem::HertzPrefactors hard = table(dem::mix(stiff, stiff), {10., 70.});
  // Round-off only.
  EXPECT_NEAR(sharp.normal, 0.5 * base.normal, 1e-14 * base.normal);
  EXPECT_NEAR(sharp.tangential, 0.5 * base.tangential, 1e-14 * base.tangential);
  EXPECT_NEAR(hard.normal, 2. * base.normal, 1e-14 * base.normal);
  EXPECT_NEAR(hard.tangential, 2. * base.tangential, 1e-14 * base.tangential);
}
