#include <dem/packing/insertion.h>
#include <dem/search/near_pairs.h>

#include <gtest/gtest.h>

#include <algorithm>

namespace
{
/// Spheres of sizes 9 : 1, anywhere in a box.
dem::Particles cloud(std::size_t n)
{
  dem::Particles stones;
  dem::Random random(3);
  for (std::size_t k = 0; k < n; ++k)
  {
    const double radius = 2.5e-3 * std::pow(9., random.uniform());
    stones.add(
        dem::make_sphere(radius),
        0.2 * dem::Vec3(random.uniform(), random.uniform(), random.uniform()),
        dem::Quaternion::Identity(), 2700.);
  }
  return stones;
}

std::vector<dem::PairKey> by_brute_force(const dem::Particles &stones,
                                         double margin)
{
  std::vector<dem::PairKey> pairs;
  for (std::size_t i = 0; i < stones.size(); ++i)
    for (std::size_t j = i + 1; j < stones.size(); ++j)
      if ((stones.position(j) - stones.position(i)).norm() - stones.radius(i) -
              stones.radius(j) <
          margin)
        pairs.emplace_back(static_cast<std::int32_t>(i),
                           static_cast<std::int32_t>(j));
  return pairs;
}
} // namespace

TEST(NearPairs, AreThoseOfBruteForceForSizesNineToOne)
{
  dem::Particles stones = cloud(600);
  dem::PairFinder finder;
  dem::Travel travel;
  dem::Random random(7);
  // What is kept from call to call must not change what is found.
  for (int call = 0; call < 12; ++call)
  {
    const double margin = call % 3 == 0 ? 2e-3 : 1e-3;
    EXPECT_EQ(finder.find(stones, dem::ContactGeometry::ball, margin, travel),
              by_brute_force(stones, margin))
        << "call " << call;
    for (dem::StoneState &stone : stones.state)
      for (int d = 0; d < 3; ++d)
        stone.position[d] +=
            5e-4 / std::sqrt(3.) * (2. * random.uniform() - 1.);
    travel.centres += 2. * 5e-4;
    travel.gaps += 2. * 5e-4;
  }
}

TEST(NearPairs, NoStonesNoPairs)
{
  dem::PairFinder finder;
  EXPECT_TRUE(finder.find({}, dem::ContactGeometry::ball, 1e-3, {}).empty());
}
