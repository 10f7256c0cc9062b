#include <gtest/gtest.h>

#include <cmath>
#include <verify/reference_impacts.h>

// The closed forms that the engine is compared with, checked by numbers of the
// literature and by balances.
namespace reference = spall::verify::reference;

namespace
{
// Chung & Ooi (2011), test 1, with its moduli; +-10 m/s.
const reference::SphereMaterial glass{2800., 48e9, 0.2};
} // namespace

// Values printed to four digits.
TEST(ReferenceImpacts, ChungAndOoiOne)
{
  const reference::HertzImpact impact =
      reference::equal_spheres(glass, 0.01, 20.);
  EXPECT_NEAR(impact.peak_overlap(), 274.1e-6, 0.05e-6);
  EXPECT_NEAR(impact.peak_force(), 10.697e3, 0.5);
  EXPECT_NEAR(impact.duration(), 40.34e-6, 0.005e-6);
}

TEST(ReferenceImpacts, ChungAndOoiTwo)
{
  const reference::HertzImpact impact =
      reference::sphere_on_rigid_plane({2699., 70e9, 0.3}, 0.1, 0.2);
  EXPECT_NEAR(impact.peak_overlap(), 49.72e-6, 0.005e-6);
  EXPECT_NEAR(impact.peak_force(), 11.370e3, 0.5);
  EXPECT_NEAR(impact.duration(), 731.7e-6, 0.05e-6);
}

// The article's ratios: 0.455 at 0.27 (Hertz), 0.240 at 0.62 (linear wall).
TEST(ReferenceImpacts, RestitutionNumbers)
{
  EXPECT_NEAR(reference::hertz_restitution(0.27), 0.455, 0.0005);
  EXPECT_NEAR(reference::linear_restitution(0.62), 0.240, 0.0005);
  EXPECT_EQ(reference::hertz_restitution(0.), 1.);
}

// Kharaz: 5 mm spheres, e 0.98, mu 0.092, 3.9 m/s. Values printed to four
// and three digits.
TEST(ReferenceImpacts, GrossSliding)
{
  const double degree = std::acos(-1.) / 180.;
  const double angles[] = {45., 60., 75.};
  const double spins[] = {502.3, 355.2, 183.9};
  const double restitutions[] = {0.818, 0.895, 0.951};
  for (int k = 0; k < 3; ++k)
  {
    const reference::GrossSliding impact{.friction = 0.092,
                                         .restitution = 0.98,
                                         .normal_speed =
                                             3.9 * std::cos(angles[k] * degree),
                                         .radius = 0.0025};
    const double tangential = 3.9 * std::sin(angles[k] * degree);
    EXPECT_NEAR(impact.spin(), spins[k], 0.05);
    EXPECT_NEAR(1. - impact.tangential_loss() / tangential, restitutions[k],
                0.0005);
    EXPECT_GT(tangential, impact.least_tangential_speed());
  }
  // Full sliding above 32.5 degrees: tan = 7/2 mu (1 + e).
  const reference::GrossSliding unit{0.092, 0.98, 1., 0.0025};
  EXPECT_NEAR(std::atan(unit.least_tangential_speed()) / degree, 32.5, 0.05);
}

// With the force T along the plane m a = m g sin - T, and with a = R alpha and
// I = 2/5 m R^2 about the centre 2/5 m a = T - mu_r N; level: T brakes.
TEST(ReferenceImpacts, RollingBalances)
{
  const reference::RollingSphere sphere{0.2, 9.81};
  const double slowing = sphere.deceleration();
  EXPECT_NEAR(0.4 * slowing, 0.2 * 9.81 - slowing, 1e-14);
  EXPECT_NEAR(sphere.stop_distance(1.), 0.7 / (0.2 * 9.81), 1e-15);

  const double angle = 0.4;
  const double down = sphere.incline_acceleration(angle);
  const double along = 9.81 * std::sin(angle) - down;
  EXPECT_NEAR(0.4 * down, along - 0.2 * 9.81 * std::cos(angle), 1e-14);
  EXPECT_EQ(sphere.incline_acceleration(std::atan(0.19)), 0.);
}

TEST(ReferenceImpacts, RockingModes)
{
  const reference::RockingModes modes = reference::rocking_modes(1., 1.);
  EXPECT_NEAR(modes.slow, 0.671, 0.0005);
  EXPECT_NEAR(modes.fast, 2.356, 0.0005);
}
