#pragma once

#include "run/thread_plan.h"

#include <dem/engine.h>

#include <chrono>
#include <vector>

namespace spall
{
/// Numbers of threads that a run may have: every power of two up to `most`, and
/// `most`; 0 stands for all cores that the process has.
std::vector<int> thread_candidates(int most);

/// Number of OpenMP threads of a run: the fastest now, as ThreadPlan finds it.
/// Results have the same bits for any number, so the number may change at any
/// step. On a busy machine threads that wait for each other can cost more than
/// they bring.
class ThreadChoice
{
public:
  /// `most` as in thread_candidates().
  explicit ThreadChoice(int most);

  /// Both are called for every step with the engine that makes it. What happens
  /// between steps, as the output of files, does not count, and neither does
  /// the search for contacts: the few steps that rebuild lists are up to sixty
  /// times as long, so that a trial with one and a trial without say nothing.
  void before_step(const dem::Engine &engine);
  void after_step(const dem::Engine &engine);
  /// A line for the log, empty if nothing has changed.
  std::string take_note() { return plan.take_note(); }

private:
  using Clock = std::chrono::steady_clock;

  ThreadPlan plan;
  Clock::time_point started;
  double searched = 0.; ///< by the clock of the engine [s]
};
} // namespace spall
