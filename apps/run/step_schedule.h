#pragma once

#include <cstdint>
#include <limits>

namespace spall
{
/// How a stage is cut into steps: into sampling intervals of equal length, each
/// of them into a whole number of equal steps, so that a run with any step
/// meets the same instants. Plain data: a checkpoint takes it as it is.
class StepSchedule
{
public:
  /// Starts a stage, or continues after `intervals` of it; infinite length: it
  /// is not known when it ends [s].
  void begin(double length, double longest_step, std::int64_t intervals = 0);
  /// From now on no step is longer than this [s].
  void replan(double longest_step);
  /// The step was done.
  void count();
  /// So many intervals are taken as done.
  void skip(std::int64_t intervals) { n_intervals += intervals; }

  double step() const { return length_of_step; }         ///< the next one [s]
  std::int64_t intervals() const { return n_intervals; } ///< done in this stage
  bool is_on_sample() const { return left == interval; }
  /// Share of this interval that is done, now and after the next step [-].
  double share_done() const { return 1. - left / interval; }
  double share_after_step() const
  {
    return steps_left == 1 ? 1. : 1. - (left - length_of_step) / interval;
  }
  std::int64_t steps_to_sample() const { return steps_left; }

private:
  double interval = std::numeric_limits<double>::infinity(); ///< [s]
  double left = interval;                   ///< of this interval [s]
  double longest = 0., length_of_step = 0.; ///< [s]
  std::int64_t steps_left = 0, n_intervals = 0;
};
} // namespace spall
