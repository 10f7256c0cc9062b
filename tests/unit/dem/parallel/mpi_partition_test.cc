// Runs on any number of ranks.
#include <dem/parallel/mpi_ranks.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <set>
#include <stdexcept>

namespace
{
using dem::Ranks;
using dem::Vec3;

struct Cloud
{
  std::vector<Vec3> points; ///< [m]
  std::vector<float> weights;
};

/// Denser at the bottom, of the size of a laboratory specimen. The same on all
/// ranks.
Cloud graded_cloud(std::size_t n)
{
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> share(0., 1.);
  Cloud cloud;
  for (std::size_t k = 0; k < n; ++k)
  {
    const double x = share(random), y = share(random), z = share(random);
    cloud.points.emplace_back(0.3 * x, 0.3 * y, 0.6 * z * z);
    cloud.weights.push_back(static_cast<float>(0.15 + 0.4 * share(random)));
  }
  return cloud;
}

/// The points that this rank gives: those with k % divisor == rank.
Cloud part_of(const Cloud &cloud, std::size_t divisor, int rank)
{
  Cloud part;
  for (std::size_t k = 0; k < cloud.points.size(); ++k)
    if (k % divisor == static_cast<std::size_t>(rank))
    {
      part.points.push_back(cloud.points[k]);
      part.weights.push_back(cloud.weights[k]);
    }
  return part;
}

void partition(Ranks &ranks, const Cloud &part)
{
  ranks.partition(part.points, part.weights);
}

std::vector<int> owners_of(const Ranks &ranks, const std::vector<Vec3> &points)
{
  std::vector<int> owners;
  for (const Vec3 &point : points)
    owners.push_back(ranks.owner(point));
  return owners;
}

/// The weight of the heaviest rank over the mean.
double imbalance(const Ranks &ranks, const Cloud &cloud)
{
  std::vector<double> weight(static_cast<std::size_t>(ranks.size()));
  double total = 0.;
  for (std::size_t k = 0; k < cloud.points.size(); ++k)
  {
    weight.at(static_cast<std::size_t>(ranks.owner(cloud.points[k]))) +=
        cloud.weights[k];
    total += cloud.weights[k];
  }
  return std::ranges::max(weight) * ranks.size() / total;
}

void expect_same_on_all_ranks(const Ranks &ranks,
                              const std::vector<int> &numbers)
{
  const auto all = ranks.gather(std::as_bytes(std::span(numbers)));
  for (const auto &other : all)
    EXPECT_EQ(other, all.front());
}

void expect_owner_among_owners(const Ranks &ranks, const Vec3 &lower,
                               const Vec3 &upper)
{
  std::vector<int> owners;
  ranks.owners(lower, upper, owners);
  EXPECT_TRUE(std::ranges::is_sorted(owners));
  EXPECT_TRUE(std::ranges::adjacent_find(owners) == owners.end());
  const auto has = [&](const Vec3 &point)
  { return std::ranges::find(owners, ranks.owner(point)) != owners.end(); };
  EXPECT_TRUE(has(0.5 * (lower + upper)));
  for (int corner = 0; corner < 8; ++corner)
    EXPECT_TRUE(has({corner & 1 ? upper.x() : lower.x(),
                     corner & 2 ? upper.y() : lower.y(),
                     corner & 4 ? upper.z() : lower.z()}));
}

TEST(MpiPartition, RankZeroOwnsAllBeforeTheFirst)
{
  const auto ranks = dem::mpi_ranks();
  EXPECT_EQ(ranks->owner({1., 2., 3.}), 0);
  std::vector<int> owners = {7};
  ranks->owners(Vec3::Zero(), Vec3::Ones(), owners);
  EXPECT_EQ(owners, std::vector<int>{0});
}

TEST(MpiPartition, BalancesPointsThatStartOnOneRank)
{
  const auto ranks = dem::mpi_ranks();
  const Cloud cloud = graded_cloud(10000);
  partition(*ranks, ranks->rank() == 0 ? cloud : Cloud{});
  const auto owners = owners_of(*ranks, cloud.points);
  expect_same_on_all_ranks(*ranks, owners);
  EXPECT_GE(std::ranges::min(owners), 0);
  EXPECT_LT(std::ranges::max(owners), ranks->size());
  EXPECT_LE(imbalance(*ranks, cloud), 1.02);
}

TEST(MpiPartition, FollowsNewWeights)
{
  const auto ranks = dem::mpi_ranks();
  Cloud cloud = graded_cloud(10000);
  partition(*ranks, ranks->rank() == 0 ? cloud : Cloud{});
  for (std::size_t k = 0; k < cloud.points.size(); ++k)
    if (cloud.points[k].z() > 0.15)
      cloud.weights[k] *= 4.f;
  if (ranks->size() > 1)
  {
    EXPECT_GT(imbalance(*ranks, cloud), 1.1);
  }
  // Every rank gives what it owns now.
  Cloud own;
  for (std::size_t k = 0; k < cloud.points.size(); ++k)
    if (ranks->owner(cloud.points[k]) == ranks->rank())
    {
      own.points.push_back(cloud.points[k]);
      own.weights.push_back(cloud.weights[k]);
    }
  partition(*ranks, own);
  expect_same_on_all_ranks(*ranks, owners_of(*ranks, cloud.points));
  EXPECT_LE(imbalance(*ranks, cloud), 1.02);
}

TEST(MpiPartition, OwnersOfABoxHoldTheOwnersOfItsPoints)
{
  const auto ranks = dem::mpi_ranks();
  const Cloud cloud = graded_cloud(10000);
  partition(*ranks, part_of(cloud, static_cast<std::size_t>(ranks->size()),
                            ranks->rank()));
  std::size_t n_boxes_of_several = 0;
  std::vector<int> owners;
  for (const Vec3 &point : cloud.points)
  {
    const Vec3 lower = point - Vec3::Constant(0.01);
    const Vec3 upper = point + Vec3::Constant(0.01);
    expect_owner_among_owners(*ranks, lower, upper);
    ranks->owners(lower, upper, owners);
    n_boxes_of_several += owners.size() > 1;
  }
  // Some, and by far not all: a box meets few neighbours.
  EXPECT_EQ(n_boxes_of_several > 0, ranks->size() > 1);
  EXPECT_LT(n_boxes_of_several, cloud.points.size() / 2);
  const double far = 1e6;
  ranks->owners(Vec3::Constant(-far), Vec3::Constant(far), owners);
  EXPECT_EQ(owners.size(), static_cast<std::size_t>(ranks->size()));
}

TEST(MpiPartition, OuterBoxesReachToInfinity)
{
  const auto ranks = dem::mpi_ranks();
  const Cloud cloud = graded_cloud(1000);
  partition(*ranks, ranks->rank() == 0 ? cloud : Cloud{});
  std::vector<Vec3> far_points;
  for (const double far : {10., 1e6, 1e300, HUGE_VAL})
    for (int axis = 0; axis < 3; ++axis)
      for (const double sign : {1., -1.})
      {
        Vec3 point(0.15, 0.15, 0.3);
        point[axis] = sign * far;
        far_points.push_back(point);
      }
  const auto owners = owners_of(*ranks, far_points);
  expect_same_on_all_ranks(*ranks, owners);
  EXPECT_GE(std::ranges::min(owners), 0);
  EXPECT_LT(std::ranges::max(owners), ranks->size());
  for (const Vec3 &point : far_points)
    expect_owner_among_owners(*ranks, point, point);
}

// Boxes of space, not their numbers: these follow where the points are.
TEST(MpiPartition, CutsDoNotDependOnWhoGivesThePoints)
{
  const auto ranks = dem::mpi_ranks();
  const auto n = static_cast<std::size_t>(ranks->size());
  const Cloud cloud = graded_cloud(3000);
  partition(*ranks, ranks->rank() == 0 ? cloud : Cloud{});
  const auto first = owners_of(*ranks, cloud.points);
  partition(*ranks, part_of(cloud, n, ranks->rank()));
  const auto second = owners_of(*ranks, cloud.points);
  std::set<std::pair<int, int>> numbers;
  for (std::size_t k = 0; k < first.size(); ++k)
    numbers.emplace(first[k], second[k]);
  EXPECT_EQ(numbers.size(), n);
}

TEST(MpiPartition, FewerPointsThanRanks)
{
  const auto ranks = dem::mpi_ranks();
  for (const std::size_t n : {1u, 2u, 3u})
    for (const int giver : {0, ranks->size() - 1})
    {
      Cloud cloud = graded_cloud(n);
      cloud.weights.assign(n, 0.3f);
      partition(*ranks, ranks->rank() == giver ? cloud : Cloud{});
      const auto owners = owners_of(*ranks, cloud.points);
      expect_same_on_all_ranks(*ranks, owners);
      EXPECT_GE(std::ranges::min(owners), 0);
      EXPECT_LT(std::ranges::max(owners), ranks->size());
      for (const Vec3 &point : cloud.points)
        expect_owner_among_owners(*ranks, point - Vec3::Constant(0.01),
                                  point + Vec3::Constant(0.01));
    }
}

TEST(MpiPartition, WithoutPointsBoxesStay)
{
  const auto ranks = dem::mpi_ranks();
  partition(*ranks, {});
  EXPECT_EQ(ranks->owner({1., 2., 3.}), 0);
  const Cloud cloud = graded_cloud(100);
  partition(*ranks, ranks->rank() == 0 ? cloud : Cloud{});
  const auto before = owners_of(*ranks, cloud.points);
  partition(*ranks, {});
  EXPECT_EQ(owners_of(*ranks, cloud.points), before);
}

TEST(MpiPartition, PointsInPlanesAndAtOnePlace)
{
  const auto ranks = dem::mpi_ranks();
  Cloud lattice;
  for (int k = 0; k < 8000; ++k)
    lattice.points.emplace_back(k % 20, k / 20 % 20, k / 400);
  lattice.weights.assign(lattice.points.size(), 1.f);
  partition(*ranks, part_of(lattice, static_cast<std::size_t>(ranks->size()),
                            ranks->rank()));
  // A plane of 400 points stays whole: half of it may be too much for a rank.
  EXPECT_LE(imbalance(*ranks, lattice), 1. + 0.025 * ranks->size());
  Cloud heap;
  heap.points.assign(50, Vec3(1., 2., 3.));
  heap.weights.assign(50, 0.7f);
  partition(*ranks, ranks->rank() == 0 ? heap : Cloud{});
  expect_same_on_all_ranks(*ranks, owners_of(*ranks, heap.points));
}

TEST(MpiPartition, BadInputOfOneRankIsRefusedOnAll)
{
  const auto ranks = dem::mpi_ranks();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const auto &[z, weight] :
       {std::pair(nan, 1.f), std::pair(HUGE_VAL, 1.f), std::pair(0., 0.f),
        std::pair(0., -1.f), std::pair(0., static_cast<float>(nan))})
  {
    Cloud cloud{{Vec3(0., 0., 0.)}, {1.f}};
    if (ranks->rank() == ranks->size() - 1)
      cloud = {{Vec3(0., 0., z)}, {weight}};
    EXPECT_THROW(partition(*ranks, cloud), std::invalid_argument);
  }
}
} // namespace
