#include <dem/stopwatch.h>

#include <algorithm>
#include <ctime>

namespace dem
{
double processor_seconds()
{
  return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

Stopwatch::Stopwatch()
    : started(std::chrono::steady_clock::now()), processor(processor_seconds())
{
}

double Stopwatch::seconds() const
{
  const std::chrono::duration<double> wall =
      std::chrono::steady_clock::now() - started;
  return std::min(wall.count(), processor_seconds() - processor);
}
} // namespace dem
