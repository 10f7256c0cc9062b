#include "test_shapes.h"

#include <dem/shape/radius_map.h>

#include <gtest/gtest.h>

// The hull of the map of a particle against a search of all its nodes.
namespace
{
using dem::RadiusMap;
using dem::Vec3;

double highest_of_all(const RadiusMap &map, const Vec3 &direction)
{
  double highest = 0.;
  for (int node = 0; node < RadiusMap::nodes.size(); ++node)
    highest = std::max(highest, map.point(node).cast<double>().dot(direction));
  return highest;
}

double farthest(const RadiusMap &map)
{
  float far = 0.f;
  for (int node = 0; node < RadiusMap::nodes.size(); ++node)
    far = std::max(far, map.point(node).norm());
  return far;
}

/// Of a particle, or (0) of a needle, whose sides see most of its nodes.
std::vector<double> series_of(int seed)
{
  constexpr int order = 12;
  return seed > 0
             ? dem::test::random_particle(order, static_cast<unsigned>(seed))
             : dem::test::project(order,
                                  [](const Vec3 &s) {
                                    return dem::test::ellipsoid_radius(
                                        {0.02, 0.008, 0.005}, s);
                                  });
}

class Hull : public testing::TestWithParam<int>
{
protected:
  RadiusMap map{
      std::make_shared<const dem::Coefficients>(series_of(GetParam()))};
  double size = farthest(map);
};

TEST_P(Hull, KnowsTheHighestNodeAlongEachSide)
{
  for (int side = 0; side < RadiusMap::sides.size(); ++side)
  {
    const Vec3 direction = RadiusMap::sides.direction(
        side / RadiusMap::sides.n_azimuth, side % RadiusMap::sides.n_azimuth);
    const int top = map.height(direction).node;
    ASSERT_NEAR(map.point(top).cast<double>().dot(direction),
                highest_of_all(map, direction), 1e-6 * size)
        << "side " << side;
  }
}

TEST_P(Hull, NoNodeIsHigher)
{
  for (const Vec3 &direction : dem::test::random_directions(500, 7))
  {
    const double highest = highest_of_all(map, direction);
    EXPECT_GE(map.height(direction).height, highest);
    EXPECT_LT(map.height(direction).height, highest + 0.04 * size);
  }
}

INSTANTIATE_TEST_SUITE_P(ParticleSystem, Hull, testing::Values(0, 5, 6, 7));
} // namespace
