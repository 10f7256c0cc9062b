#pragma once

#include <chrono>
#include <vector>

namespace spall
{
/// Numbers of threads that a run may have: `fixed`, or if that is 0 every power
/// of two up to all cores, and all cores.
std::vector<int> thread_candidates(int fixed);

/// Number of OpenMP threads of a run: fixed, or the one that is fastest now.
/// Results have the same bits for any number, so the choice may change at any
/// step; on a busy machine threads that wait for each other can cost more than
/// they bring.
class ThreadChoice
{
public:
  /// Of several candidates each gets a hundred steps, the fastest is kept, and
  /// they are asked again every 10 000 steps.
  explicit ThreadChoice(int fixed);

  /// To be called before every step.
  void before_step();

private:
  using Clock = std::chrono::steady_clock;
  void start_trial(std::size_t candidate);

  std::vector<int> candidates;
  std::size_t trial = 0, best = 0;
  double best_time = 0.; ///< of a trial [s]
  int steps = 0;
  Clock::time_point started;
};
} // namespace spall
