// Runs on any number of ranks.
#include <dem/parallel/mpi_ranks.h>
#include <dem/parallel/mpi_session.h>
#include <dem/parallel/rank_sums.h>

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>

namespace
{
std::vector<std::byte> bytes(std::size_t n, int seed)
{
  std::vector<std::byte> result(n);
  for (std::size_t k = 0; k < n; ++k)
    result[k] = static_cast<std::byte>(
        (k * 31 + k / 251 + static_cast<std::size_t>(seed)) % 256);
  return result;
}

TEST(MpiRanks, SumsIntegers)
{
  const auto ranks = dem::mpi_ranks();
  const std::int64_t n = ranks->size(), r = ranks->rank();
  const std::int64_t large = std::int64_t{1} << 60;
  std::array<std::int64_t, 3> values = {r, -2, r == 0 ? large + 1 : r};
  ranks->sum(values);
  EXPECT_EQ(values[0], n * (n - 1) / 2);
  EXPECT_EQ(values[1], -2 * n);
  EXPECT_EQ(values[2], large + 1 + n * (n - 1) / 2);
  ranks->sum({});
}

TEST(MpiRanks, FindsLargestValues)
{
  const auto ranks = dem::mpi_ranks();
  std::array<double, 2> values = {0.1 * ranks->rank(), -1. - ranks->rank()};
  ranks->max(values);
  EXPECT_EQ(values[0], 0.1 * (ranks->size() - 1));
  EXPECT_EQ(values[1], -1.);
}

TEST(MpiRanks, ExactSumsDoNotDependOnWhoAdds)
{
  const auto ranks = dem::mpi_ranks();
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> exponent(-20., 8.);
  std::array<dem::ExactSum, 2> own, all;
  for (int k = 0; k < 1000; ++k)
    for (std::size_t entry = 0; entry < 2; ++entry)
    {
      const double term =
          std::pow(10., exponent(random)) * (random() % 2 ? 1. : -1.);
      all[entry].add(term);
      if (k % ranks->size() == ranks->rank())
        own[entry].add(term);
    }
  dem::sum_over_ranks(*ranks, own);
  EXPECT_EQ(own, all);
}

TEST(MpiRanks, GathersBytesOfAllRanks)
{
  const auto ranks = dem::mpi_ranks();
  // Nothing from rank 0.
  const auto length = [](int rank)
  { return static_cast<std::size_t>(1000 * rank); };
  const auto all = ranks->gather(bytes(length(ranks->rank()), ranks->rank()));
  ASSERT_EQ(all.size(), static_cast<std::size_t>(ranks->size()));
  for (int r = 0; r < ranks->size(); ++r)
    EXPECT_EQ(all[static_cast<std::size_t>(r)], bytes(length(r), r));
}

/// Empty for the own rank; the others grow from none to two megabytes.
std::vector<std::byte> content(int from, int to)
{
  return bytes(from == to ? 0 : static_cast<std::size_t>(from) * 1000003,
               from * 16 + to);
}

TEST(MpiRanks, DeliversParcelsFromEveryRankToEveryRank)
{
  const auto ranks = dem::mpi_ranks();
  std::vector<dem::Parcel> parcels;
  for (int to = ranks->size() - 1; to >= 0; --to)
    parcels.push_back({to, content(ranks->rank(), to)});
  const auto arrived = ranks->deliver(parcels);
  ASSERT_EQ(arrived.size(), static_cast<std::size_t>(ranks->size()));
  for (int from = 0; from < ranks->size(); ++from)
  {
    const dem::Parcel &parcel = arrived[static_cast<std::size_t>(from)];
    EXPECT_EQ(parcel.rank, from);
    EXPECT_EQ(parcel.content, content(from, ranks->rank()));
  }
}

TEST(MpiRanks, DeliversParcelsToSomeRanksOnly)
{
  const auto ranks = dem::mpi_ranks();
  const int last = ranks->size() - 1;
  std::vector<dem::Parcel> parcels;
  if (ranks->rank() == 0)
    parcels.push_back({last, bytes(10, 3)});
  const auto arrived = ranks->deliver(parcels);
  ASSERT_EQ(arrived.size(), ranks->rank() == last ? 1u : 0u);
  if (!arrived.empty())
  {
    EXPECT_EQ(arrived.front().rank, 0);
    EXPECT_EQ(arrived.front().content, bytes(10, 3));
  }
  EXPECT_TRUE(ranks->deliver({}).empty());
}

struct Item
{
  std::int64_t sender = 0, index = 0;
  std::array<double, 11> rest{};
  bool operator==(const Item &) const = default;
};

std::vector<Item> numbered_items(int rank, std::size_t n)
{
  std::vector<Item> items(n);
  for (std::size_t k = 0; k < n; ++k)
  {
    items[k].sender = rank;
    items[k].index = static_cast<std::int64_t>(k);
    items[k].rest[3] = 0.5 * static_cast<double>(k);
  }
  return items;
}

/// Sends items forward, changes them, sends them back, and compares.
void there_and_back(dem::ExchangePlan &plan, int rank, double change)
{
  const auto sent = numbered_items(rank, plan.n_sent());
  std::vector<Item> received(plan.n_received());
  plan.forward(sent.data(), sizeof(Item), received.data());
  // By the rank of the sender, then in its order.
  for (std::size_t k = 1; k < received.size(); ++k)
    EXPECT_LT(std::pair(received[k - 1].sender, received[k - 1].index),
              std::pair(received[k].sender, received[k].index));
  for (Item &item : received)
    item.rest[3] += change;
  std::vector<Item> returned(plan.n_sent());
  plan.reverse(received.data(), sizeof(Item), returned.data());
  for (Item &item : returned)
    item.rest[3] -= change;
  EXPECT_EQ(returned, sent);
  // Another size on the same way.
  std::vector<std::int64_t> numbers, answers(plan.n_sent());
  for (const Item &item : received)
    numbers.push_back(100 * item.sender + item.index);
  plan.reverse(numbers.data(), sizeof(std::int64_t), answers.data());
  for (std::size_t k = 0; k < answers.size(); ++k)
    EXPECT_EQ(answers[k], 100 * rank + static_cast<std::int64_t>(k));
}

TEST(MpiRanks, PlanGoesForwardAndBack)
{
  const auto ranks = dem::mpi_ranks();
  const int n = ranks->size();
  std::vector<int> destination;
  for (int k = 0; k < 1000; ++k) // not sorted by rank
    destination.push_back((k * k + ranks->rank()) % n);
  const auto plan = ranks->plan(destination);
  ASSERT_EQ(plan->n_sent(), destination.size());
  std::array<std::int64_t, 2> counts = {
      static_cast<std::int64_t>(plan->n_sent()),
      static_cast<std::int64_t>(plan->n_received())};
  ranks->sum(counts);
  EXPECT_EQ(counts[0], counts[1]);
  for (const double change : {1., 2., 4.})
    there_and_back(*plan, ranks->rank(), change);
}

TEST(MpiRanks, PlansOfWhichSomeRanksHaveNothing)
{
  const auto ranks = dem::mpi_ranks();
  const int last = ranks->size() - 1;
  const auto first_to_last =
      ranks->plan(std::vector<int>(ranks->rank() == 0 ? 7 : 0, last));
  const auto all_to_first =
      ranks->plan(std::vector<int>(static_cast<std::size_t>(ranks->rank()), 0));
  EXPECT_EQ(first_to_last->n_received(), ranks->rank() == last ? 7u : 0u);
  there_and_back(*first_to_last, ranks->rank(), 1.);
  there_and_back(*all_to_first, ranks->rank(), 1.);
  there_and_back(*ranks->plan({}), ranks->rank(), 1.);
}

TEST(MpiRanks, PlanOutlivesItsRanks)
{
  auto ranks = dem::mpi_ranks();
  const int rank = ranks->rank();
  const auto plan = ranks->plan(std::vector<int>(5, rank));
  ranks.reset();
  there_and_back(*plan, rank, 1.);
}

TEST(MpiSession, LeavesMpiToWhoStartedIt)
{
  {
    const dem::MpiSession second;
  }
  EXPECT_EQ(dem::mpi_ranks()->size() > 0, true);
}
} // namespace
