#include "run/forecast.h"

#include "run/cost.h"
#include "run/first_rank.h"
#include "run/thread_choice.h"

#include <dem/parallel/distribution.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace spall
{
namespace
{
/// What a half takes, what one that continues to a whole period takes at most,
/// and beyond which expectation that is not tried [s].
constexpr double half = 5., longest_half = 30., hopeless = 120.;

/// What has been run.
struct Ran
{
  double time = 0.;  ///< simulated [s]
  double spent = 0.; ///< by Stopwatch [s]
  double n_steps = 0.;
  double n_frames = 0.;
};

Ran operator-(const Ran &a, const Ran &b)
{
  return {a.time - b.time, a.spent - b.spent, a.n_steps - b.n_steps,
          a.n_frames - b.n_frames};
}

/// By the engine, its clock and the frames since a start.
class Meter
{
public:
  Meter(const dem::Engine &e, const std::function<int()> &frames)
      : engine(e), n_frames(frames), start(read())
  {
  }
  Ran ran() const { return read() - start; }

private:
  Ran read() const
  {
    return {engine.time(), watch.seconds(),
            static_cast<double>(engine.n_steps()),
            static_cast<double>(n_frames())};
  }

  const dem::Engine &engine;
  const std::function<int()> &n_frames;
  Stopwatch watch;
  Ran start;
};

/// Simulated time after which the period that has begun is over; what has been
/// run if that is not worth waiting for [s].
double whole_periods(const Ran &ran, double period)
{
  if (period <= 0.)
    return ran.time;
  const double length = std::ceil(ran.time / period) * period;
  return ran.spent * length / ran.time > hopeless ? ran.time : length;
}
} // namespace

MeanStep time_steps(const dem::Engine &engine, const TestTimes &test,
                    int threads, const std::function<bool()> &advance)
{
  const dem::Ranks &ranks = engine.distribution().ranks();
  ThreadChoice choice(threads);
  const Meter meter(engine, test.n_frames);
  const auto run_until = [&](const std::function<bool()> &is_enough)
  {
    bool is_on = true;
    // Clocks of ranks differ: when the first of them is at its end, all are.
    while (is_on && !on_any_rank(ranks, is_enough()))
    {
      choice.before_step(engine);
      is_on = advance();
      choice.after_step(engine);
    }
    return is_on;
  };
  const auto run_half = [&](const Ran &before)
  {
    const auto ran = [&] { return meter.ran() - before; };
    if (!run_until([&] { return ran().spent > half; }))
      return false;
    const double length = whole_periods(ran(), test.period);
    return run_until(
        [&]
        {
          const Ran now = ran();
          return now.time >= length || now.spent > longest_half;
        });
  };
  Ran before;
  if (run_half(before))
  {
    before = meter.ran();
    run_half(before);
  }
  const Ran all = meter.ran(), last = all - before;
  const double left = std::max(0., test.duration - all.time) / last.time;
  const double n = all.n_steps + left * last.n_steps;
  const double unseen =
      test.frame_interval > 0.
          ? left * (last.time / test.frame_interval - last.n_frames)
          : 0.;
  return {(all.time + left * last.time) / n,
          (all.spent + left * last.spent) / n, unseen};
}

void print_predicted(double duration, const MeanStep &step)
{
  const double n = duration / step.length;
  std::printf("predicted time   %.3g s for %.4g steps of %.3g s after the "
              "preparation (%.3g ms each)\n",
              step.cost * n, n, step.length, 1e3 * step.cost);
}

MeanStep time_particles(dem::Engine &engine, double length)
{
  const Stopwatch watch;
  int n = 0;
  for (bool is_enough = false; !is_enough; ++n)
  {
    engine.advance_deferred(length);
    is_enough = on_any_rank(engine.distribution().ranks(),
                            watch.seconds() >= 0.1 * half);
  }
  engine.synchronize();
  return {length, watch.seconds() / n};
}

void print_preparing(double duration, const MeanStep &step)
{
  const double n = duration / step.length;
  std::printf("to prepare       about %.2g s before that for some %.2g steps: "
              "a guess, to a factor of two\n",
              step.cost * n, n);
}
} // namespace spall
