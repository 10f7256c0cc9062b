#include <dem/packing/insertion.h>
#include <dem/search/candidates.h>
#include <dem/search/near_pairs.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <shape/test_shapes.h>

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

TEST(NearPairs, AreThoseOfBruteForceForStonesThatMoveAtTheirOwnPace)
{
  const auto series =
      std::make_shared<const dem::Coefficients>(dem::test::random_stone(8, 8));
  dem::Random random(5);
  dem::Particles stones;
  for (int k = 0; k < 150; ++k)
    stones.add(
        dem::make_body(series, 4e-3 + 4e-3 * random.uniform()),
        0.07 * dem::Vec3(random.uniform(), random.uniform(), random.uniform()),
        random.rotation(), 2700.);
  const double slope = 1. + dem::steepness(stones);
  dem::PairFinder kept;
  dem::Travel travel;
  std::size_t n_found = 0;
  for (int call = 0; call < 12; ++call)
  {
    dem::PairFinder knows_nothing;
    const auto found =
        kept.find(stones, dem::ContactGeometry::radial, 5e-4, travel);
    EXPECT_EQ(found, knows_nothing.find(stones, dem::ContactGeometry::radial,
                                        5e-4, travel))
        << "call " << call;
    n_found += found.size();
    // Every tenth stone is quick, the others creep.
    for (std::size_t k = 0; k < stones.size(); ++k)
    {
      const double pace = k % 10 == 0 ? 4e-4 : 1e-5;
      stones.position(k) += pace * (random.rotation() * dem::Vec3::UnitX());
      stones.travelled[k] += slope * pace;
    }
    travel.centres += 2. * 4e-4;
  }
  EXPECT_GT(n_found, 1000u);
}

TEST(NearPairs, NoStonesNoPairs)
{
  dem::PairFinder finder;
  EXPECT_TRUE(finder.find({}, dem::ContactGeometry::ball, 1e-3, {}).empty());
}
