#include "run/step_schedule.h"

#include <gtest/gtest.h>

#include <cmath>

using spall::StepSchedule;

// A fixed step: every step is a tick, and no digit is lost.
TEST(StepSchedule, FixedStepIsKeptToTheLastBit)
{
  StepSchedule pace;
  pace.begin(1e-6, 1e-6);
  for (int step = 0; step < 1000; ++step)
  {
    EXPECT_EQ(pace.step(), 1e-6);
    EXPECT_TRUE(pace.is_on_sample());
    EXPECT_EQ(pace.share_after_step(), 1.);
    EXPECT_EQ(pace.ticks(), step);
    pace.count();
  }
}

// Whatever the longest step does, ticks are met and no step is longer.
TEST(StepSchedule, MeetsEveryTick)
{
  StepSchedule pace;
  constexpr double tick = 1e-3;
  pace.begin(tick, 3.3e-6);
  double time = 0.;
  int n_on_sample = 0;
  for (int step = 0; step < 20000; ++step)
  {
    const double longest = 1e-6 * (1.1 + std::sin(0.01 * step));
    if (step % 7 == 0)
    {
      pace.replan(longest);
      EXPECT_LE(pace.step(), longest * (1. + 1e-8));
    }
    EXPECT_GT(pace.step(), 0.);
    const double share = pace.share_after_step();
    time += pace.step();
    pace.count();
    EXPECT_NEAR(pace.share_done(), std::fmod(share, 1.), 1e-9);
    if (pace.is_on_sample())
    {
      ++n_on_sample;
      // Twenty thousand rounded sums.
      EXPECT_NEAR(time, tick * static_cast<double>(pace.ticks()), 1e-12);
    }
  }
  EXPECT_EQ(n_on_sample, pace.ticks());
  EXPECT_GT(n_on_sample, 10);
}

TEST(StepSchedule, WithoutEndTheStepIsTheLongest)
{
  StepSchedule pace;
  pace.begin(std::numeric_limits<double>::infinity(), 2e-6);
  EXPECT_EQ(pace.step(), 2e-6);
  pace.count();
  pace.replan(1e-6);
  EXPECT_EQ(pace.step(), 1e-6);
  EXPECT_EQ(pace.ticks(), 0);
}
