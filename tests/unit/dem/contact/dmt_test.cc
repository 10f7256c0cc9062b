#include <dem/contact/laws/dmt.h>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace
{
constexpr double work_of_adhesion = 0.12, range = 2e-5, radius = 4e-3;
const dem::LawValues values{work_of_adhesion, range};
const dem::Prefactors<double> of{3e8, 2e8, radius};
const double pull_off = 2. * std::numbers::pi * radius * work_of_adhesion;

dem::NormalSpring<double> at(double overlap)
{
  return dem::Dmt::spring<double>(values, of, overlap);
}
} // namespace

TEST(Dmt, PullsWithTheForceOfDerjaguin)
{
  EXPECT_NEAR(at(0.).force, -pull_off, 1e-12 * pull_off);
  EXPECT_NEAR(at(-0.25 * range).force, -0.75 * pull_off, 1e-12 * pull_off);
  EXPECT_NEAR(at(-range).force, 0., 1e-12 * pull_off);
  EXPECT_EQ(at(-2. * range).force, 0.);
  EXPECT_NEAR(at(1e-6).force, of.normal * std::pow(1e-6, 1.5) - pull_off,
              1e-12 * pull_off);
}

TEST(Dmt, SeparationFromTouchCostsPiRWH)
{
  const double cost = std::numbers::pi * radius * work_of_adhesion * range;
  EXPECT_NEAR(at(0.).energy, -cost, 1e-12 * cost);
  EXPECT_NEAR(at(-range).energy, 0., 1e-12 * cost);
  // The force over the way, by the midpoint rule, exact where it is linear.
  constexpr int n = 100;
  double work = 0.;
  for (int k = 0; k < n; ++k)
    work -= at(-range * (k + 0.5) / n).force * range / n;
  EXPECT_NEAR(work, cost, 1e-12 * cost);
}

// A central difference of h = 1e-5 of the range.
TEST(Dmt, ForceIsTheSlopeOfTheEnergy)
{
  const double h = 1e-5 * range;
  for (const double overlap : {-0.9 * range, -0.1 * range, 1e-6, 5e-6})
    EXPECT_NEAR((at(overlap + h).energy - at(overlap - h).energy) / (2. * h),
                at(overlap).force, 1e-5 * pull_off);
}

// Friction and breakage see what presses.
TEST(Dmt, PressingPartIsHertz)
{
  const dem::NormalSpring<double> spring = at(2e-6);
  const dem::NormalSpring<double> hertz =
      dem::Hertz::spring<double>({}, of, 2e-6);
  EXPECT_NEAR(spring.force + spring.attraction, hertz.force,
              1e-12 * hertz.force);
  EXPECT_EQ(spring.stiffness, hertz.stiffness);
  EXPECT_EQ(spring.shear_stiffness, hertz.shear_stiffness);
}
