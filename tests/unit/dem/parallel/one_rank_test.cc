#include <dem/parallel/rank_sums.h>
#include <dem/parallel/ranks.h>

#include <gtest/gtest.h>

#include <array>
#include <stdexcept>

namespace
{
std::vector<std::byte> bytes(std::initializer_list<int> values)
{
  std::vector<std::byte> result;
  for (const int value : values)
    result.push_back(static_cast<std::byte>(value));
  return result;
}

TEST(OneRank, IsTheOnlyOne)
{
  const auto ranks = dem::one_rank();
  EXPECT_EQ(ranks->rank(), 0);
  EXPECT_EQ(ranks->size(), 1);
}

TEST(OneRank, SumsAndLargestValuesAreItsOwn)
{
  const auto ranks = dem::one_rank();
  std::array<std::int64_t, 2> counts = {3, -4};
  std::array<double, 2> speeds = {0.5, -2.};
  ranks->sum(counts);
  ranks->max(speeds);
  EXPECT_EQ(counts, (std::array<std::int64_t, 2>{3, -4}));
  EXPECT_EQ(speeds, (std::array<double, 2>{0.5, -2.}));
  std::array<dem::ExactSum, 2> sums;
  sums[0].add(-0.1);
  sums[1].add(1e12);
  const auto before = sums;
  dem::sum_over_ranks(*ranks, sums);
  EXPECT_EQ(sums, before);
}

TEST(OneRank, GathersAndDeliversToItself)
{
  const auto ranks = dem::one_rank();
  const auto own = bytes({1, 2, 3});
  ASSERT_EQ(ranks->gather(own).size(), 1u);
  EXPECT_EQ(ranks->gather(own).front(), own);
  const auto arrived = ranks->deliver({{0, own}});
  ASSERT_EQ(arrived.size(), 1u);
  EXPECT_EQ(arrived.front().rank, 0);
  EXPECT_EQ(arrived.front().content, own);
  EXPECT_TRUE(ranks->deliver({}).empty());
}

TEST(OneRank, PlanKeepsTheOrder)
{
  const auto ranks = dem::one_rank();
  const std::array<int, 3> destination = {0, 0, 0};
  const auto plan = ranks->plan(destination);
  ASSERT_EQ(plan->n_sent(), 3u);
  ASSERT_EQ(plan->n_received(), 3u);
  const std::array<double, 3> items = {1., 2., 3.};
  std::array<double, 3> received{}, returned{};
  plan->forward(items.data(), sizeof(double), received.data());
  EXPECT_EQ(received, items);
  plan->reverse(received.data(), sizeof(double), returned.data());
  EXPECT_EQ(returned, items);
  const auto empty = ranks->plan({});
  EXPECT_EQ(empty->n_received(), 0u);
  empty->forward(nullptr, sizeof(double), nullptr);
  empty->reverse(nullptr, sizeof(double), nullptr);
}

TEST(OneRank, OwnsAllOfSpace)
{
  const auto ranks = dem::one_rank();
  const std::vector<dem::Vec3> points = {dem::Vec3::Zero(), dem::Vec3::Ones()};
  ranks->partition(points, std::array<float, 2>{1.f, 2.f});
  EXPECT_EQ(ranks->owner({1e9, 0., 0.}), 0);
  std::vector<int> owners = {5, 6};
  ranks->owners(points[0], points[1], owners);
  EXPECT_EQ(owners, std::vector<int>{0});
  EXPECT_THROW(ranks->partition(points, std::array<float, 2>{1.f, 0.f}),
               std::invalid_argument);
}
} // namespace
