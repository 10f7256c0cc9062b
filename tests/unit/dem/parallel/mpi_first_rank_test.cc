// What the first rank has, on all of them.
#include <dem/parallel/first_rank.h>
#include <dem/parallel/mpi_ranks.h>
#include <dem/vector.h>

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace
{
struct Plain
{
  dem::Vec3 point = dem::Vec3::Zero();
  double number = 0.;
  std::int64_t count = 0;
};

TEST(FirstRank, HasTheSayForAllRanks)
{
  const auto ranks = dem::mpi_ranks();
  const int rank = ranks->rank();
  const std::string text =
      dem::of_first_rank(*ranks, "rank " + std::to_string(rank));
  EXPECT_EQ(text, "rank 0");

  const Plain own{{1. + rank, 2., 3.}, 0.1 * (1 + rank), 7 - rank};
  const Plain first = dem::of_first_rank(*ranks, own);
  EXPECT_EQ(first.point, dem::Vec3(1., 2., 3.));
  EXPECT_EQ(first.number, 0.1);
  EXPECT_EQ(first.count, 7);

  // Of another length on each rank.
  const std::vector<double> entries(3 + static_cast<std::size_t>(rank),
                                    0.5 + rank);
  EXPECT_EQ(dem::of_first_rank(*ranks, entries), std::vector<double>(3, 0.5));
}

TEST(FirstRank, NothingIsNothingOnAllRanks)
{
  const auto ranks = dem::mpi_ranks();
  const bool is_first = ranks->rank() == 0;
  EXPECT_EQ(
      dem::of_first_rank(*ranks, std::string(is_first ? "" : "of another")),
      "");
  EXPECT_TRUE(dem::of_first_rank(*ranks, std::vector<int>(is_first ? 0 : 5, 1))
                  .empty());
}
} // namespace
