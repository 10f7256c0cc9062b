#include "run/step_schedule.h"

#include <gtest/gtest.h>

#include <cmath>

using spall::StepSchedule;

// A fixed step: every step is a interval, and no digit is lost.
TEST(StepSchedule, FixedStepIsKeptToTheLastBit)
{
  StepSchedule schedule;
  schedule.begin(1e-6, 1e-6);
  for (int step = 0; step < 1000; ++step)
  {
    EXPECT_EQ(schedule.step(), 1e-6);
    EXPECT_TRUE(schedule.is_on_sample());
    EXPECT_EQ(schedule.share_after_step(), 1.);
    EXPECT_EQ(schedule.intervals(), step);
    schedule.count();
  }
}

// Whatever the longest step does, intervals are met and no step is longer.
TEST(StepSchedule, MeetsEveryTick)
{
  StepSchedule schedule;
  constexpr double interval = 1e-3;
  schedule.begin(interval, 3.3e-6);
  double time = 0.;
  int n_on_sample = 0;
  for (int step = 0; step < 20000; ++step)
  {
    const double longest = 1e-6 * (1.1 + std::sin(0.01 * step));
    if (step % 7 == 0)
    {
      schedule.replan(longest);
      EXPECT_LE(schedule.step(), longest * (1. + 1e-8));
    }
    EXPECT_GT(schedule.step(), 0.);
    const double share = schedule.share_after_step();
    time += schedule.step();
    schedule.count();
    EXPECT_NEAR(schedule.share_done(), std::fmod(share, 1.), 1e-9);
    if (schedule.is_on_sample())
    {
      ++n_on_sample;
      // Twenty thousand rounded sums.
      EXPECT_NEAR(time, interval * static_cast<double>(schedule.intervals()),
                  1e-12);
    }
  }
  EXPECT_EQ(n_on_sample, schedule.intervals());
  EXPECT_GT(n_on_sample, 10);
}

TEST(StepSchedule, WithoutEndTheStepIsTheLongest)
{
  StepSchedule schedule;
  schedule.begin(std::numeric_limits<double>::infinity(), 2e-6);
  EXPECT_EQ(schedule.step(), 2e-6);
  schedule.count();
  schedule.replan(1e-6);
  EXPECT_EQ(schedule.step(), 1e-6);
  EXPECT_EQ(schedule.intervals(), 0);
}
