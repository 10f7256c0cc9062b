#include "subgrade/scene.h"

#include <dem/measure/solid_fraction.h>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace
{
using namespace spall;

dem::ParticleSystem one_ball(const dem::Vec3 &centre, double radius)
{
  dem::ParticleSystem particles;
  particles.add(dem::make_sphere(radius), centre, dem::Quaternion::Identity(),
                2750.);
  return particles;
}

// A ball in the column below a plate, and one that its edge halves.
TEST(SubgradeDensity, IsOfTheColumnBelowThePlate)
{
  const double r = 0.02, volume = 4. / 3. * std::numbers::pi * r * r * r;
  LoadPlateParameters sleeper;
  sleeper.form = PlateForm::block;
  sleeper.length = 0.12;
  sleeper.width = 0.08;
  const dem::Prism column = column_below(sleeper, 0., 0.06);
  const double share = volume / (0.12 * 0.08 * 0.06);
  EXPECT_NEAR(dem::solid_fraction(column, one_ball({0., 0., 0.03}, r)), share,
              0.005 * share);
  EXPECT_NEAR(dem::solid_fraction(column, one_ball({0.06, 0., 0.03}, r)),
              0.5 * share, 0.01 * share);
  LoadPlateParameters disc;
  disc.form = PlateForm::disc;
  disc.diameter = 0.1;
  const double section =
      16. * 0.05 * 0.05 * std::sin(2. * std::numbers::pi / 32.);
  EXPECT_NEAR(dem::solid_fraction(column_below(disc, 0., 0.06),
                                  one_ball({0.01, 0., 0.03}, r)),
              volume / (section * 0.06), 0.005 * volume / (section * 0.06));
}
} // namespace
