#include "run/thread_choice.h"

#include <gtest/gtest.h>

#include <functional>

namespace
{
using spall::ThreadPlan;

/// Seconds that a step takes on a number of threads.
using StepTime = std::function<double(int)>;

/// Feeds steps until `seconds` have passed; returns the time that the same
/// steps would have taken on one thread.
double pass(ThreadPlan &plan, const StepTime &step, double seconds)
{
  double single = 0.;
  for (double now = 0.; now < seconds;)
  {
    const double took = step(plan.threads());
    plan.step_took(took);
    now += took;
    single += step(1);
  }
  return single;
}

double idle(int n_threads)
{
  return 2.7e-4 / (1. + 0.8 * (n_threads - 1));
}

/// The rates of the quick case beside two busy loops.
double busy(int n_threads)
{
  return n_threads == 1 ? 1. / 3700. : 1. / 197.;
}
} // namespace

TEST(ThreadPlan, OneNumberStays)
{
  ThreadPlan plan({1});
  pass(plan, busy, 1.);
  EXPECT_EQ(plan.threads(), 1);
  EXPECT_EQ(plan.take_note(), "");
}

TEST(ThreadPlan, IdleMachineKeepsAllThreads)
{
  ThreadPlan plan({1, 2});
  pass(plan, idle, 1.);
  EXPECT_EQ(plan.take_note(), "");
  // Rounds cost less than 2 % of the speed: 1.8 is what two threads bring.
  EXPECT_GT(pass(plan, idle, 60.), 0.98 * 1.8 * 60.);
  EXPECT_EQ(plan.take_note(), "");
}

TEST(ThreadPlan, BusyMachineRunsOnOneThread)
{
  ThreadPlan plan({1, 2});
  // From the first second on at 0.9 of one thread; 0.7 is asked.
  EXPECT_GT(pass(plan, busy, 1.), 0.7);
  EXPECT_NE(plan.take_note().find("1 instead of 2"), std::string::npos);
  EXPECT_GT(pass(plan, busy, 60.), 0.9 * 60.);
}

TEST(ThreadPlan, FallsBackAtOnceAndComesBack)
{
  ThreadPlan plan({1, 2});
  pass(plan, idle, 2.);
  ASSERT_EQ(plan.take_note(), "");
  EXPECT_GT(pass(plan, busy, 1.), 0.7);
  EXPECT_NE(plan.take_note().find("1 instead of 2"), std::string::npos);
  pass(plan, busy, 61.);
  plan.take_note();
  pass(plan, idle, 5.);
  EXPECT_GT(pass(plan, idle, 10.), 0.98 * 1.8 * 10.);
}

// A load that comes and goes must not fill the log.
TEST(ThreadPlan, LogHasAtMostOneLineAMinute)
{
  ThreadPlan plan({1, 2});
  int n_lines = 0;
  for (int turn = 0; turn < 20; ++turn)
  {
    pass(plan, turn % 2 == 0 ? busy : idle, 6.);
    n_lines += plan.take_note().empty() ? 0 : 1;
  }
  EXPECT_GE(n_lines, 1);
  EXPECT_LE(n_lines, 3); // 120 s
}

// Steps of a large specimen: seconds, not numbers of steps, bound a trial.
TEST(ThreadPlan, LongStepsAreJudgedAfterFewOfThem)
{
  const auto long_idle = [](int n) { return 0.2 / n; };
  const auto long_busy = [](int n) { return n == 1 ? 0.2 : 1.; };
  ThreadPlan plan({1, 2, 4});
  pass(plan, long_idle, 5.);
  EXPECT_EQ(plan.threads(), 4);
  EXPECT_GT(pass(plan, long_busy, 30.), 0.7 * 30.);
}

// More threads may be slower than a few: half of the number in use is tried.
TEST(ThreadPlan, FindsTheNumberBetween)
{
  ThreadPlan plan({1, 2, 4, 8});
  const auto best_at_four = [](int n) { return n <= 4 ? 1e-3 / n : 1e-3 / 2.; };
  pass(plan, best_at_four, 2.);
  EXPECT_EQ(plan.threads(), 4);
}

// Rebuilt lists make every 150th step thirty times as long.
TEST(ThreadPlan, SomeLongStepsDoNotChangeTheNumber)
{
  ThreadPlan plan({1, 2});
  int n_steps = 0;
  const auto uneven = [&n_steps](int n)
  { return idle(n) * (n_steps % 150 == 0 ? 30. : 1.); };
  double on_one = 0.;
  for (double now = 0.; now < 60.; ++n_steps)
  {
    const double took = uneven(plan.threads());
    on_one += uneven(1);
    plan.step_took(took);
    now += took;
  }
  EXPECT_GT(on_one, 0.95 * 1.8 * 60.);
}

TEST(ThreadChoice, NumbersUpToTheMost)
{
  EXPECT_EQ(spall::thread_candidates(1), (std::vector<int>{1}));
  EXPECT_EQ(spall::thread_candidates(2), (std::vector<int>{1, 2}));
  EXPECT_EQ(spall::thread_candidates(6), (std::vector<int>{1, 2, 4, 6}));
  EXPECT_EQ(spall::thread_candidates(0).front(), 1);
}
