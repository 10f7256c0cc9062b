#pragma once

#include <chrono>

namespace dem
{
/// Of all threads of this program since its start [s].
double processor_seconds();

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
} // namespace dem
