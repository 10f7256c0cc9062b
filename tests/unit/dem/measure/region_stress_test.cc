#include "packings.h"

#include <dem/measure/region_stress.h>

#include <gtest/gtest.h>

#include <stdexcept>

namespace
{
using packings::radius;

dem::Prism cube(double low, double high)
{
  return dem::prism_of(dem::Vec3::Constant(low), dem::Vec3::Constant(high));
}
} // namespace

TEST(Prism, LosesItsSkinOnAllSides)
{
  const dem::Prism box = dem::prism_of({0., 0., 0.}, {0.3, 0.2, 0.1});
  EXPECT_NEAR(box.volume(), 6e-3, 1e-16);
  EXPECT_NEAR(dem::without_skin(box, 0.02).volume(), 0.26 * 0.16 * 0.06, 1e-16);
  EXPECT_THROW(dem::without_skin(box, 0.06), std::invalid_argument);
  // A regular hexagon of apothem 1: area 2 sqrt(3).
  dem::Prism hexagon{{}, 0., 1.};
  for (int k = 0; k < 6; ++k)
    hexagon.corners.push_back(
        2. / std::sqrt(3.) *
        Eigen::Vector2d(std::cos(k * std::numbers::pi / 3.),
                        std::sin(k * std::numbers::pi / 3.)));
  EXPECT_NEAR(dem::without_skin(hexagon, 0.25).volume(),
              2. * std::sqrt(3.) * 0.75 * 0.75 * 0.5, 1e-14);
}

TEST(Prism, HasTheCornersOfARim)
{
  // A rectangle with points on its sides, in no order.
  dem::Prism prism{dem::corners_through({{3., 1.},
                                         {0., 0.},
                                         {1., 0.},
                                         {3., 2.},
                                         {0., 2.},
                                         {3., 0.},
                                         {0., 0.5},
                                         {2., 2.}}),
                   0., 1.};
  EXPECT_EQ(prism.corners.size(), 4u);
  EXPECT_NEAR(prism.volume(), 6., 1e-14);
}

TEST(Prism, OfACylinderHasItsVolume)
{
  const dem::Prism round =
      dem::prism_of_cylinder({0.3, -0.2}, 0.075, 0.01, 0.16);
  const double volume = std::numbers::pi * 0.075 * 0.075 * 0.15;
  EXPECT_NEAR(round.volume(), volume, 1e-14);
  // A skin is taken off the sides, which are at cos(pi / 72) of the corners.
  const double inner = std::numbers::pi * 0.055 * 0.055 * 0.11;
  EXPECT_NEAR(dem::without_skin(round, 0.02).volume(), inner, 1e-3 * inner);
  EXPECT_TRUE(dem::part_inside(round, {0.3, -0.126, 0.1}, {0.3, 0., 0.1}));
  EXPECT_FALSE(dem::part_inside(round, {0.3, -0.124, 0.1}, {0.3, 0., 0.1}));
}

TEST(Prism, CutsALine)
{
  const dem::Prism box = cube(0., 1.);
  const auto part = dem::part_inside(box, {-1., 0.5, 0.5}, {3., 0.5, 0.5});
  ASSERT_TRUE(part);
  EXPECT_DOUBLE_EQ(part->first, 0.25);
  EXPECT_DOUBLE_EQ(part->second, 0.5);
  EXPECT_FALSE(dem::part_inside(box, {-1., 0.5, 0.5}, {-2., 0.5, 0.5}));
  EXPECT_FALSE(dem::part_inside(box, {-0.6, 0.5, 0.5}, {0.5, -0.7, 0.5}));
}

// One column per (2 r)^2 of section: sigma_zz = F / (2 r)^2, wherever the
// region ends along z.
TEST(MeanStress, OfASimpleCubicPacking)
{
  const auto packing =
      packings::touching(packings::simple_cubic(6), [](const dem::Vec3 &normal)
                         { return normal.z() > 0.5 ? 7. : 2.; });
  dem::Prism prism = cube(2. * radius, 8. * radius);
  prism.low += 0.3 * radius;
  prism.high -= 0.9 * radius;
  const dem::Mat3 stress =
      dem::mean_stress(prism, packing.particles, packing.network);
  const double area = 4. * radius * radius;
  EXPECT_NEAR(stress(2, 2), 7. / area, 1e-12 * 7. / area);
  // Across, columns lie in layers: whole ones alone have the mean.
  const dem::Mat3 whole = dem::mean_stress(cube(2. * radius, 8. * radius),
                                           packing.particles, packing.network);
  EXPECT_NEAR(whole(0, 0), 2. / area, 1e-12 * 7. / area);
  EXPECT_NEAR(whole(0, 1), 0., 1e-12 / area);
}

// p = F / (sqrt(2) r^2), all contacts alike, over a whole number of cells that
// begins anywhere.
TEST(MeanStress, OfAFaceCentredPacking)
{
  const auto packing = packings::touching(packings::face_centred(4),
                                          [](const dem::Vec3 &) { return 5.; });
  const double cell = packings::fcc_cell, shift = 0.37 * cell;
  const dem::Mat3 stress =
      dem::mean_stress(cube(cell + shift, 3. * cell + shift), packing.particles,
                       packing.network);
  const double pressure = 5. / (std::numbers::sqrt2 * radius * radius);
  EXPECT_LT((stress - pressure * dem::Mat3::Identity()).norm(),
            1e-12 * pressure);
}

// A sphere on a platen: the line to the contact on the platen counts.
TEST(MeanStress, TakesInWalls)
{
  auto packing = packings::touching({dem::Vec3(radius, radius, radius)},
                                    [](const dem::Vec3 &) { return 0.; });
  for (const double z : {0., 2. * radius})
    packing.network.walls.push_back(
        {0, {radius, radius, z}, {0., 0., z == 0. ? 4. : -4.}});
  const dem::Mat3 stress = dem::mean_stress(cube(0., 2. * radius),
                                            packing.particles, packing.network);
  EXPECT_NEAR(stress(2, 2), 4. / (4. * radius * radius), 1e-9);
}
