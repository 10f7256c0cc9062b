#pragma once

#include <chrono>

namespace dem
{
/// Adds the wall-clock of its own life to a phase.
class PhaseTimer
{
public:
  explicit PhaseTimer(double &phase) : sum(phase), start(Clock::now()) {}
  ~PhaseTimer()
  {
    sum += std::chrono::duration<double>(Clock::now() - start).count();
  }
  PhaseTimer(const PhaseTimer &) = delete;
  PhaseTimer &operator=(const PhaseTimer &) = delete;

private:
  using Clock = std::chrono::steady_clock;
  double &sum;
  Clock::time_point start;
};
} // namespace dem
