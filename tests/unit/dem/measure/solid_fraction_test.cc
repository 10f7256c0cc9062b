#include <dem/measure/assembly.h>
#include <dem/measure/solid_fraction.h>

#include <gtest/gtest.h>

#include <numbers>

namespace
{
constexpr double radius = 0.02;
constexpr double volume = 4. / 3. * std::numbers::pi * radius * radius * radius;

dem::ParticleSystem balls(const std::vector<dem::Vec3> &centres)
{
  dem::ParticleSystem particles;
  for (const dem::Vec3 &centre : centres)
    particles.add(dem::make_sphere(radius), centre, dem::Quaternion::Identity(),
                  2750.);
  return particles;
}

// Points are a hundredth of the height apart; two balls at one position fill it
// once.
TEST(SolidFraction, IsThatOfTheSpaceWithOverlapsOnce)
{
  const dem::Prism box = dem::prism_of({0., 0., 0.}, {0.12, 0.08, 0.06});
  const double share = volume / box.volume();
  const dem::Vec3 middle(0.06, 0.04, 0.03);
  EXPECT_NEAR(dem::solid_fraction(box, balls({middle})), share, 0.005 * share);
  EXPECT_NEAR(dem::solid_fraction(box, balls({middle, middle})), share,
              0.005 * share);
  EXPECT_NEAR(dem::solid_fraction(box, balls({{0.12, 0.04, 0.03}})),
              0.5 * share, 0.01 * share);
}

TEST(SolidVolume, IsTheSumOfAllParticles)
{
  const dem::Vec3 origin = dem::Vec3::Zero();
  EXPECT_EQ(dem::solid_volume(balls({}), *dem::one_rank()), 0.);
  EXPECT_NEAR(dem::solid_volume(balls({origin, origin}), *dem::one_rank()),
              2. * volume, 1e-12 * volume);
}
} // namespace
