#include <coupling/window_length.h>

#include <gtest/gtest.h>

#include <initializer_list>

// How many steps of the particles make a window: by the gain of the contacts
// and by what the ledger says.
namespace
{
using coupling::LedgerSums;
using coupling::WindowLength;

/// Of a ledger in which `astray` of `moved` got lost [J].
LedgerSums books(double energy_error, double moved)
{
  LedgerSums sums;
  sums.given = moved;
  sums.taken = moved - energy_error;
  sums.moved = moved;
  return sums;
}

WindowLength of_tolerance(int most, double tolerance)
{
  WindowLength length(most);
  length.follow(tolerance);
  return length;
}
} // namespace

TEST(WindowLength, StaysUnlessItIsToAdapt)
{
  const WindowLength length(12);
  EXPECT_EQ(length.steps(), 12);
  for (const std::int64_t n : {1, 64, 640})
    EXPECT_FALSE(length.is_due(n));
}

// The gain goes with the square of the length, and 0.8 of its limit is used:
// four times the limit at 16 steps leaves 16 sqrt(0.2) = 7.2.
TEST(WindowLength, FollowsTheGain)
{
  WindowLength length = of_tolerance(16, 1e-3);
  ASSERT_TRUE(length.is_due(64));
  ASSERT_FALSE(length.is_due(65));
  length.update(4., books(0.9e-3, 1.), 64);
  EXPECT_EQ(length.steps(), 7);
  length.update(1e4, books(0.9e-3, 1.), 128);
  EXPECT_EQ(length.steps(), 1);
}

// Halved where more is lost than may since the last look, as before where
// it is less, a quarter longer where it is less than a quarter.
TEST(WindowLength, FollowsTheLedger)
{
  WindowLength length = of_tolerance(16, 1e-3);
  length.update(0., books(1.1e-3, 1.), 64);
  EXPECT_EQ(length.steps(), 8);
  length.update(0., books(2.2e-3, 2.), 128);
  EXPECT_EQ(length.steps(), 4);
  length.update(0., books(2.7e-3, 3.), 192);
  EXPECT_EQ(length.steps(), 4);
  for (const int steps : {5, 6, 7, 8, 10, 12, 15, 16, 16})
  {
    length.update(0., books(2.7e-3, 4.), 256);
    EXPECT_EQ(length.steps(), steps);
  }
}

// Where hardly anything crosses, a share of it says nothing: what is lost
// counts against the mean of all windows.
TEST(WindowLength, AtRestTheMeanCounts)
{
  WindowLength length = of_tolerance(8, 1e-3);
  length.update(0., books(0.5e-3, 1.), 64);
  length.update(0., books(0.5e-3 + 0.4e-3, 1. + 1e-6), 128);
  EXPECT_EQ(length.steps(), 8); // 0.4e-3 of 0.5 J
  length.update(0., books(0.9e-3 + 0.6e-3, 1. + 1e-6), 192);
  EXPECT_EQ(length.steps(), 4); // 0.6e-3 of 0.33 J
}

TEST(WindowLength, IsCapped)
{
  WindowLength length = of_tolerance(50, 1e-3);
  length.cap(3);
  EXPECT_EQ(length.steps(), 3);
  length.update(0., {}, 64);
  EXPECT_EQ(length.steps(), 3);
}
