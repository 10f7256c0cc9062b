#include <fem/drucker_prager.h>

#include <gtest/gtest.h>

#include <cmath>

namespace
{
using fem::Voigt;

constexpr double E = 40e6, nu = 0.3;

fem::DruckerPrager soil(double phi, double psi, double cohesion = 20e3)
{
  return fem::drucker_prager(E, nu, {cohesion, phi, psi});
}

double yield(const fem::DruckerPrager &law, const Voigt &s)
{
  const double p = (s(0) + s(1) + s(2)) / 3.;
  const double j2 =
      ((s(0) - s(1)) * (s(0) - s(1)) + (s(1) - s(2)) * (s(1) - s(2)) +
       (s(2) - s(0)) * (s(2) - s(0))) /
          6. +
      s(3) * s(3) + s(4) * s(4) + s(5) * s(5);
  return std::sqrt(j2) + law.friction * p - law.strength;
}

/// Gradient of sqrt(J2) + slope p as a strain, by central differences.
Voigt gradient(const fem::DruckerPrager &law, const Voigt &s, double slope)
{
  fem::DruckerPrager other = law;
  other.friction = slope;
  Voigt result;
  for (int i = 0; i < 6; ++i)
  {
    Voigt up = s, down = s;
    up(i) += 1.;
    down(i) -= 1.;
    result(i) = (yield(other, up) - yield(other, down)) / 2.;
  }
  return result;
}

const Voigt strain_path =
    (Voigt() << -2e-3, 0.7e-3, 0.2e-3, 0.9e-3, -0.5e-3, 1.1e-3).finished();

/// Where a path begins: inside, and not on the line of the strains.
Voigt first_stress()
{
  Voigt s = Voigt::Zero();
  s.head<4>() << -24e3, -17e3, -20e3, -3e3;
  return s;
}

/// Not too far: in the end the stress no longer changes.
const Voigt sideways = 0.8 * strain_path;

/// Rate equations in n steps of Heun's method from where the path meets the
/// cone, with no return: dsigma = C (deps - lambda g), lambda such that
/// sigma stays on the cone.
Voigt integrated(const fem::DruckerPrager &law, int n)
{
  const fem::VoigtMatrix c =
      fem::elasticity(law.bulk_modulus, law.shear_modulus);
  const auto rate = [&](const Voigt &s) -> Voigt
  {
    const Voigt normal = gradient(law, s, law.friction);
    const Voigt flow = gradient(law, s, law.dilatancy);
    return c * sideways -
           normal.dot(c * sideways) / normal.dot(c * flow) * (c * flow);
  };
  double low = 0., high = 1.;
  for (int k = 0; k < 60; ++k)
  {
    const double middle = 0.5 * (low + high);
    (yield(law, first_stress() + middle * (c * sideways)) < 0. ? low : high) =
        middle;
  }
  Voigt s = first_stress() + high * (c * sideways);
  const double step = (1. - high) / n;
  for (int k = 0; k < n; ++k)
  {
    const Voigt first = rate(s);
    s += 0.5 * step * (first + rate(s + step * first));
  }
  return s;
}

Voigt returned(const fem::DruckerPrager &law, int n)
{
  const fem::VoigtMatrix c =
      fem::elasticity(law.bulk_modulus, law.shear_modulus);
  Voigt s = first_stress();
  for (int k = 0; k < n; ++k)
    s = fem::return_stress(law, s + c * sideways / n).stress;
  return s;
}

// Mohr and Coulomb in a triaxial test: sigma_1 = sigma_3 (1 + sin phi) / (1 -
// sin phi) + 2 c cos phi / (1 - sin phi), at any lateral pressure.
TEST(DruckerPrager, TriaxialStrengthIsThatOfMohrAndCoulomb)
{
  for (const double phi : {0., 0.2, 0.6})
    for (const double lateral : {0., 10e3, 100e3})
    {
      const fem::DruckerPrager law = soil(phi, phi);
      const double exact =
          (lateral * (1. + std::sin(phi)) + 2. * 20e3 * std::cos(phi)) /
          (1. - std::sin(phi));
      Voigt s = Voigt::Zero();
      s.head<3>() << -lateral, -lateral, -exact;
      EXPECT_NEAR(yield(law, s), 0., 1e-9 * exact);
      s(2) *= 0.999;
      EXPECT_LT(yield(law, s), 0.);
      EXPECT_EQ(fem::return_stress(law, s).region, fem::YieldRegion::inside);
      s(2) *= 1.01 / 0.999;
      EXPECT_EQ(fem::return_stress(law, s).region, fem::YieldRegion::cone);
    }
}

TEST(DruckerPrager, ReturnsToTheConeOrToItsApex)
{
  const fem::DruckerPrager law = soil(0.5, 0.2);
  const fem::VoigtMatrix c =
      fem::elasticity(law.bulk_modulus, law.shear_modulus);
  const auto cone = fem::return_stress(law, c * strain_path);
  EXPECT_EQ(cone.region, fem::YieldRegion::cone);
  EXPECT_NEAR(yield(law, cone.stress), 0., 1e-9 * law.strength);
  // The flow is the multiplier times the gradient of the potential at the end.
  const Voigt flow = fem::elastic_strain(law, c * strain_path - cone.stress);
  const Voigt expected =
      cone.multiplier * gradient(law, cone.stress, law.dilatancy);
  EXPECT_LT((flow - expected).norm(), 1e-8 * flow.norm());

  Voigt apart = Voigt::Zero();
  apart.head<3>().setConstant(2e-3);
  apart(3) = 1e-4;
  const auto apex = fem::return_stress(law, c * apart);
  EXPECT_EQ(apex.region, fem::YieldRegion::apex);
  const double tip = 20e3 / std::tan(0.5); // c cot phi
  for (int i = 0; i < 6; ++i)
    EXPECT_NEAR(apex.stress(i), i < 3 ? tip : 0., 1e-9 * tip);
  const fem::DruckerPrager clay = soil(0., 0.);
  const auto torn = fem::return_stress(clay, c * apart);
  EXPECT_EQ(torn.region, fem::YieldRegion::inside); // no apex without friction
}

// The return of many steps meets the rate equations, in first order.
TEST(DruckerPrager, MeetsTheIntegratedRateEquations)
{
  for (const double psi : {0., 0.2, 0.5})
  {
    const fem::DruckerPrager law = soil(0.5, psi, 5e3);
    const Voigt exact = integrated(law, 20000);
    const auto error = [&](const fem::DruckerPrager &of, int n)
    { return (returned(of, n) - exact).norm() / exact.norm(); };
    std::printf("psi %.1f: errors %.2e %.2e %.2e\n", psi, error(law, 50),
                error(law, 100), error(law, 200));
    EXPECT_NEAR(error(law, 50) / error(law, 100), 2., 0.2);
    EXPECT_NEAR(error(law, 100) / error(law, 200), 2., 0.1);
    EXPECT_LT(error(law, 1000), 1e-4);
    for (double fem::DruckerPrager::*one :
         {&fem::DruckerPrager::friction, &fem::DruckerPrager::strength,
          &fem::DruckerPrager::bulk_modulus,
          &fem::DruckerPrager::shear_modulus})
    {
      fem::DruckerPrager wrong = law;
      wrong.*one *= 1.01;
      EXPECT_GT(error(wrong, 1000), 3e-4) << "psi " << psi;
    }
  }
}

TEST(DruckerPrager, TangentIsTheDerivative)
{
  for (const double psi : {0., 0.2, 0.5})
  {
    const fem::DruckerPrager law = soil(0.5, psi);
    const fem::VoigtMatrix c =
        fem::elasticity(law.bulk_modulus, law.shear_modulus);
    const auto stress = [&](const Voigt &strain) -> Voigt
    { return fem::return_stress(law, c * strain).stress; };
    const auto result = fem::return_stress(law, c * strain_path);
    ASSERT_EQ(result.region, fem::YieldRegion::cone);
    const fem::VoigtMatrix tangent =
        fem::consistent_tangent(law, c * strain_path, result);
    fem::VoigtMatrix numeric;
    for (int j = 0; j < 6; ++j)
    {
      Voigt step = Voigt::Zero();
      step(j) = 1e-8;
      numeric.col(j) =
          (stress(strain_path + step) - stress(strain_path - step)) / 2e-8;
    }
    EXPECT_LT((tangent - numeric).norm(), 1e-6 * numeric.norm());
    const double skew = (tangent - tangent.transpose()).norm();
    if (psi == 0.5)
      EXPECT_LT(skew, 1e-9 * tangent.norm());
    else
      EXPECT_GT(skew, 1e-2 * tangent.norm());
  }
}
} // namespace
