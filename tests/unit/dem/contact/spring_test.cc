#include <dem/contact/elliptic.h>
#include <dem/contact/laws/hertz.h>

#include <gtest/gtest.h>

#include <cmath>

namespace
{
const dem::Elasticity particle{.shear_modulus = 5e8, .poisson_ratio = 0.25};
const dem::Elasticity rigid{.is_rigid = true};

void expect_relative(double value, double exact, double tolerance)
{
  EXPECT_NEAR(value, exact, tolerance * std::abs(exact));
}

dem::NormalSpring<double> spring_of(const dem::HertzPrefactors &prefactors,
                                    double overlap)
{
  return dem::Hertz::spring<double>(
      {}, {prefactors.normal, prefactors.tangential}, overlap);
}
} // namespace

// The spring of the engine, differenced with h = 1e-4 delta: a central
// difference errs by less than h^2 / delta^2.
TEST(HertzSpring, ForceAndTangentAreDerivatives)
{
  const dem::HertzPrefactors prefactors =
      dem::elliptic_table()(dem::mix(particle, rigid), {20., 130.});
  for (const double overlap : {1e-7, 1e-5, 1e-3})
  {
    const double h = 1e-4 * overlap;
    const dem::NormalSpring<double> here = spring_of(prefactors, overlap);
    const dem::NormalSpring<double> more = spring_of(prefactors, overlap + h);
    const dem::NormalSpring<double> less = spring_of(prefactors, overlap - h);
    expect_relative((more.energy - less.energy) / (2. * h), here.force, 1e-8);
    expect_relative((more.force - less.force) / (2. * h), here.stiffness, 1e-8);
    // 1e-14: round-off.
    expect_relative(here.force, prefactors.normal * std::pow(overlap, 1.5),
                    1e-14);
    expect_relative(here.shear_stiffness,
                    prefactors.tangential * std::sqrt(overlap), 1e-14);
  }
}

TEST(HertzSpring, NoOverlapNoForce)
{
  const dem::HertzPrefactors prefactors =
      dem::elliptic_table()(dem::mix(particle, rigid), {20., 130.});
  const dem::NormalSpring<double> spring = spring_of(prefactors, 0.);
  EXPECT_EQ(spring.force, 0.);
  EXPECT_EQ(spring.stiffness, 0.);
  EXPECT_EQ(spring.energy, 0.);
  EXPECT_EQ(spring.shear_stiffness, 0.);
}

// One per cent of any coefficient moves the prefactors by far more than any
// tolerance above, and by what the derivative says.
TEST(HertzSpring, OnePerCentIsSeen)
{
  const auto prefactors = [](double shear, double poisson, double a, double b)
  {
    const dem::Elasticity body{.shear_modulus = shear,
                               .poisson_ratio = poisson};
    return dem::elliptic_table()(dem::mix(body, rigid), {a, b});
  };
  const dem::HertzPrefactors base = prefactors(5e8, 0.25, 20., 130.);
  const auto change = [&base](const dem::HertzPrefactors &other)
  { return other.normal / base.normal - 1.; };
  // C_H ~ G / (1 - nu); 1e-12 is round-off.
  EXPECT_NEAR(change(prefactors(5.05e8, 0.25, 20., 130.)), 0.01, 1e-12);
  EXPECT_NEAR(change(prefactors(5e8, 0.2525, 20., 130.)), 0.75 / 0.7475 - 1.,
              1e-12);
  // Both gap coefficients together: C_H ~ (A B)^(-1/4) at fixed ratio. Each
  // alone lowers C_H by 0.1 % at least.
  EXPECT_NEAR(change(prefactors(5e8, 0.25, 20.2, 131.3)),
              1. / std::sqrt(1.01) - 1., 1e-12);
  EXPECT_LT(change(prefactors(5e8, 0.25, 20.2, 130.)), -1e-3);
  EXPECT_LT(change(prefactors(5e8, 0.25, 20., 131.3)), -1e-3);
  EXPECT_GT(
      std::abs(prefactors(5e8, 0.2525, 20., 130.).tangential / base.tangential -
               1.),
      1e-3);
}
