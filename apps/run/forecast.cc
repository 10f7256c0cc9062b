#include "run/forecast.h"

#include "run/cost.h"
#include "run/thread_choice.h"

#include <algorithm>
#include <cstdio>

namespace spall
{
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

MeanStep time_steps(const dem::Engine &engine, int threads,
                    const std::function<bool()> &advance)
{
  constexpr double half = 5.; // [s]
  ThreadChoice choice(threads);
  const Stopwatch watch;
  double since = 0., from = engine.time();
  std::int64_t steps_before = engine.n_steps();
  bool is_on = true;
  while (is_on && watch.seconds() < 2. * half)
  {
    if (since == 0. && watch.seconds() > half)
    {
      since = watch.seconds();
      from = engine.time();
      steps_before = engine.n_steps();
    }
    choice.before_step();
    is_on = advance();
  }
  const auto n = static_cast<double>(engine.n_steps() - steps_before);
  return {(engine.time() - from) / n, (watch.seconds() - since) / n};
}

void print_predicted(double duration, const MeanStep &step)
{
  const double n = duration / step.length;
  std::printf("predicted time   %.3g s for %.4g steps of %.3g s after the "
              "preparation (%.3g ms each)\n",
              step.cost * n, n, step.length, 1e3 * step.cost);
}
} // namespace spall
