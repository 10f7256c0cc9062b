#pragma once

#include <dem/engine.h>

#include <chrono>
#include <functional>

namespace spall
{
/// Wall-clock or processor time since it was made, whichever is less: what
/// others take of the machine is not in it.
class Stopwatch
{
public:
  Stopwatch();
  double seconds() const;

private:
  std::chrono::steady_clock::time_point started;
  double processor;
};

/// A step on average.
struct MeanStep
{
  double length = 0.; ///< [s]
  double cost = 0.;   ///< by Stopwatch [s]
};

/// Steps of a test for ten seconds, or until `advance` says that it is over;
/// the first half of the time, in which it gets going, does not count unless
/// there is no other. `threads` as for ThreadChoice.
MeanStep time_steps(const dem::Engine &engine, int threads,
                    const std::function<bool()> &advance);

/// The line for a test of this length after its preparation [s].
void print_predicted(double duration, const MeanStep &step);
} // namespace spall
