#include "packings.h"

#include <dem/measure/boundary_profile.h>
#include <dem/random.h>

#include <gtest/gtest.h>

#include <algorithm>

namespace
{
using packings::radius;

double same(const dem::Vec3 &)
{
  return 1.;
}

/// Porosity of a simple cubic packing between two distances from the wall its
/// first layer touches: 1 - int pi (r^2 - (z - r)^2) dz / (4 r^2 dz).
double exact_porosity(double from, double to)
{
  const auto solid = [](double z)
  { return std::numbers::pi * (radius * z * z - z * z * z / 3.); };
  return 1. - (solid(to) - solid(from)) / (4. * radius * radius * (to - from));
}

/// Of layers along the distance from the four sides of a simple cubic packing,
/// from random points.
std::vector<double> thrown_porosities(int n, std::size_t n_layers, double layer)
{
  std::vector<double> n_points(n_layers), n_free(n_layers);
  const double side = 2. * n * radius;
  dem::Random random(1);
  for (int k = 0; k < 2000000; ++k)
  {
    const dem::Vec3 x =
        side * dem::Vec3(random.uniform(), random.uniform(), random.uniform());
    const double depth = std::min({x.x(), side - x.x(), x.y(), side - x.y()});
    const auto at =
        std::min(static_cast<std::size_t>(depth / layer), n_layers - 1);
    const dem::Vec3 in_cell =
        x - 2. * radius * (x / (2. * radius)).array().floor().matrix();
    n_points[at] += 1.;
    n_free[at] += (in_cell - dem::Vec3::Constant(radius)).norm() > radius;
  }
  for (std::size_t k = 0; k < n_layers; ++k)
    n_free[k] /= n_points[k];
  return n_free;
}

/// An upright square tube of two triangles a side.
dem::FacetSurface square_tube(double side, double height)
{
  dem::FacetSurface tube;
  const double x[] = {0., side, side, 0.}, y[] = {0., 0., side, side};
  for (const double z : {0., height})
    for (int k = 0; k < 4; ++k)
      tube.position.emplace_back(x[k], y[k], z);
  for (std::int32_t k = 0; k < 4; ++k)
  {
    const std::int32_t next = (k + 1) % 4;
    tube.triangles.push_back({k, next, next + 4});
    tube.triangles.push_back({k, next + 4, k + 4});
  }
  return tube;
}
} // namespace

namespace
{
/// A square tube whose side grows by `more` of itself from both ends to the
/// middle of the height, evenly; triangles seen from outside.
dem::FacetSurface square_barrel(double side, double height, double more)
{
  dem::FacetSurface tube;
  const double x[] = {-0.5, 0.5, 0.5, -0.5}, y[] = {-0.5, -0.5, 0.5, 0.5};
  for (const double level : {0., 0.5, 1.})
    for (int k = 0; k < 4; ++k)
    {
      const double here = side * (level == 0.5 ? 1. + more : 1.);
      tube.position.emplace_back(here * x[k], here * y[k], level * height);
    }
  for (std::int32_t row = 0; row < 8; row += 4)
    for (std::int32_t k = 0; k < 4; ++k)
    {
      const std::int32_t a = row + k, b = row + (k + 1) % 4;
      tube.triangles.push_back({a, b, b + 4});
      tube.triangles.push_back({b + 4, a + 4, a});
    }
  return tube;
}
} // namespace

TEST(Outline, AreasOfABarrelAndItsBulge)
{
  constexpr double side = 0.1, height = 0.2, more = 0.08;
  constexpr int n = 48;
  const std::vector<double> areas = dem::section_areas(
      dem::outline_of(square_barrel(side, height, more), 0., height, n));
  ASSERT_EQ(areas.size(), static_cast<std::size_t>(n));
  const auto exact = [](double share)
  {
    const double grown = 1. + more * (1. - std::abs(2. * share - 1.));
    return side * side * grown * grown;
  };
  for (std::size_t k = 0; k < areas.size(); ++k)
    EXPECT_NEAR(areas[k], exact((static_cast<double>(k) + 0.5) / n), 1e-15);
  // Means of (1 + m s)^2 over the thirds of s that the ends and the middle
  // are, s the share of the way from an end to the middle.
  const auto mean = [](double from, double to)
  {
    const auto power = [](double s) { return std::pow(1. + more * s, 3); };
    return (power(to) - power(from)) / (3. * more * (to - from));
  };
  EXPECT_NEAR(dem::bulge_of(areas), mean(2. / 3., 1.) / mean(0., 1. / 3.) - 1.,
              1e-5);
}

TEST(Outline, AreaOfAPrismAndTooFewSections)
{
  const dem::Outline box = dem::outline_of(
      dem::prism_of(dem::Vec3(0.1, 0.2, 0.), dem::Vec3(0.4, 0.4, 1.)), 6);
  const std::vector<double> areas = dem::section_areas(box);
  ASSERT_EQ(areas.size(), 6u);
  for (const double area : areas)
    EXPECT_NEAR(area, 0.06, 1e-15);
  EXPECT_NEAR(dem::bulge_of(areas), 0., 1e-14);
  EXPECT_TRUE(std::isnan(dem::bulge_of(std::span(areas).first(5))));
}

TEST(BoundaryProfile, OfASimpleCubicPacking)
{
  constexpr int n = 6;
  const double side = 2. * n * radius;
  const auto packing = packings::touching(packings::simple_cubic(n), same);
  const dem::Outline box = dem::outline_of(
      dem::prism_of(dem::Vec3::Zero(), dem::Vec3::Constant(side)), 20 * n);
  const auto profile = dem::boundary_profile(packing.particles, packing.network,
                                             box, {0.4 * radius, 2. * radius});
  const std::vector<double> thrown = thrown_porosities(n, 15, 0.4 * radius);
  ASSERT_EQ(profile.platens.porosity.size(), 15u);
  ASSERT_EQ(profile.lateral.porosity.size(), 15u);
  for (std::size_t k = 0; k < 10; ++k)
  {
    const double from = static_cast<double>(k % 5) * 0.4 * radius;
    EXPECT_NEAR(profile.platens.distance[k],
                (static_cast<double>(k) + 0.5) * 0.4 * radius, 1e-12);
    // Points in cells of a tenth of the radius: 0.3 % of a layer at most.
    EXPECT_NEAR(profile.platens.porosity[k],
                exact_porosity(from, from + 0.4 * radius), 3e-3);
    // Some 1e5 random points in a layer: three times 0.5 / sqrt(1e5).
    EXPECT_NEAR(profile.lateral.porosity[k], thrown[k], 5e-3);
  }
  // Particles at the wall have five neighbours (one fewer each at an edge of
  // two walls), those inside six.
  for (const dem::LayerProfile &layers : {profile.lateral, profile.platens})
  {
    EXPECT_NEAR(layers.coordination[7], 6., 1e-12);
    EXPECT_TRUE(std::isnan(layers.coordination[0]));
  }
  EXPECT_NEAR(profile.lateral.coordination[2], (16. * 5. + 4. * 4.) / 20.,
              1e-12);
  EXPECT_NEAR(profile.platens.coordination[2], 5., 1e-12);
  const double porosity = 1. - std::numbers::pi / 6.;
  EXPECT_NEAR(profile.porosity, porosity, 1e-3);
  EXPECT_NEAR(profile.porosity_inside, porosity, 2e-3);
  EXPECT_NEAR(profile.porosity_skin, porosity, 2e-3);
  // The skin at the side without those at the platens: one particle deep.
  EXPECT_NEAR(profile.coordination_skin, (16. * 5. + 4. * 4.) / 20., 1e-12);
  EXPECT_NEAR(profile.coordination_inside, 6., 1e-12);
}

TEST(BoundaryProfile, OfAFaceCentredPackingIsItsPorosity)
{
  const double cell = packings::fcc_cell;
  const auto packing = packings::touching(packings::face_centred(4), same);
  const dem::Outline box = dem::outline_of(
      dem::prism_of(dem::Vec3::Constant(cell), dem::Vec3::Constant(3. * cell)),
      120);
  const auto profile = dem::boundary_profile(packing.particles, packing.network,
                                             box, {cell, 0.});
  EXPECT_NEAR(profile.porosity, 1. - std::numbers::pi / (3. * std::sqrt(2.)),
              1e-3);
  EXPECT_NEAR(profile.lateral.coordination[0], 12., 1e-12);
}

TEST(BoundaryProfile, OfATubeIsThatOfTheBox)
{
  const double side = 6. * radius;
  const auto packing = packings::touching(packings::simple_cubic(3), same);
  const auto in_box = dem::boundary_profile(
      packing.particles, packing.network,
      dem::outline_of(
          dem::prism_of(dem::Vec3::Zero(), dem::Vec3::Constant(side)), 60),
      {0.4 * radius, 0.});
  const auto in_tube = dem::boundary_profile(
      packing.particles, packing.network,
      dem::outline_of(square_tube(side, side), 0., side, 60),
      {0.4 * radius, 0.});
  for (std::size_t k = 0; k < in_box.lateral.porosity.size(); ++k)
    EXPECT_NEAR(in_box.lateral.porosity[k], in_tube.lateral.porosity[k], 1e-12);
}
