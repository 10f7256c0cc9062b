#pragma once

#include <dem/engine.h>
#include <dem/stopwatch.h>

#include <functional>

namespace spall
{
using dem::Stopwatch;

/// A step on average.
struct MeanStep
{
  double length = 0.; ///< [s]
  double cost = 0.;   ///< by Stopwatch [s]
  /// Frames of the whole test that are not in that cost; < 0: too many are [-].
  double unseen_frames = 0.;
};

/// Of a test after its preparation.
struct TestTimes
{
  double duration = 0.;       ///< [s]
  double period = 0.;         ///< of its load or motion; 0: none [s]
  double frame_interval = 0.; ///< 0: frames come with the steps [s]
  std::function<int()> n_frames = [] { return 0; }; ///< written so far
};

/// Steps of a test for ten seconds, or until `advance` returns that it is over,
/// and from them the mean over its duration. What has been run takes what it
/// took, and what is left costs as much as the second half of that. Either half
/// continues to a whole period, if one takes no more than half a minute:
/// impacts and events have their times in it, and the first load breaks most.
/// Frames at intervals are longer than that apart; what the rest has more or
/// less of them than the second half is said. `threads` as for ThreadChoice.
MeanStep time_steps(const dem::Engine &engine, const TestTimes &test,
                    int threads, const std::function<bool()> &advance);

/// The line for a test of this length after its preparation [s].
void print_predicted(double duration, const MeanStep &step);

/// Steps of the particles alone, of this length [s], for half a second.
MeanStep time_particles(dem::Engine &engine, double length);

/// And for its preparation, of this length in such steps [s].
void print_preparing(double duration, const MeanStep &step);
} // namespace spall
