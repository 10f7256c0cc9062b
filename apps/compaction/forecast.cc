// How long a vibratory compaction will take: a lower one is run and timed.
#include "compaction/compaction.h"

#include <array>
#include <chrono>
#include <cstdio>

namespace spall
{
namespace
{
/// Of the vibration that is timed.
constexpr double n_periods = 4.;

/// What a stage took, or will take.
struct StageCost
{
  double time = 0.;  ///< simulated [s]
  double steps = 0.; ///< [-]
  double wall = 0.;  ///< wall-clock [s]

  /// So much more time, each of it so much dearer.
  StageCost scaled(double longer, double dearer) const
  {
    return {longer * time, longer * steps, longer * dearer * wall};
  }
};

/// With half of the layers, and a few turns of the exciter.
Case lower_case(Case c)
{
  const int n = c.filling.layers;
  c.filling.layers = (n + 1) / 2;
  c.container.height *= static_cast<double>(c.filling.layers) / n;
  c.vibration.duration = n_periods / c.vibration.frequency;
  c.vibration.reports.clear();
  return c;
}

/// By stage.
std::array<StageCost, 3> timed(LabTest &test, const auto &stage_now)
{
  using Clock = std::chrono::steady_clock;
  std::array<StageCost, 3> cost;
  auto since = Clock::now();
  double time = 0.;
  std::int64_t steps = 0;
  for (auto stage = stage_now(); stage < cost.size(); ++stage)
  {
    while (stage_now() == stage && test.share_done() < 1.)
      test.advance();
    const auto now = Clock::now();
    cost[stage] = {test.engine().time() - time,
                   static_cast<double>(test.engine().n_steps() - steps),
                   std::chrono::duration<double>(now - since).count()};
    since = now;
    time = test.engine().time();
    steps = test.engine().n_steps();
  }
  return cost;
}
} // namespace

/// Layer k is poured on k - 1 others; the plate goes down by the same strain; a
/// step costs as much as there are stones.
void Compaction::print_forecast()
{
  Compaction lower(lower_case(parameters));
  auto [filling, seating, vibration] = timed(
      lower, [&lower] { return static_cast<std::size_t>(lower.now.stage); });
  const double spent = filling.wall + seating.wall + vibration.wall;
  const double n = parameters.filling.layers,
               m = lower.parameters.filling.layers, more = n / m;
  filling = filling.scaled(more, (n + 1.) / (m + 1.));
  const double still = parameters.plate.seating_time / seating.time;
  seating = seating.scaled(more * (1. - still) + still, more);
  vibration =
      vibration.scaled(parameters.vibration.duration / vibration.time, more);
  std::printf("predicted time   %.3g s for %.4g steps: filling %.3g s, seating "
              "of the plate %.3g s, vibration %.3g s (steps of %.3g s, %.3g ms "
              "each); %.0f of %.0f layers took %.3g s\n",
              filling.wall + seating.wall + vibration.wall,
              filling.steps + seating.steps + vibration.steps, filling.wall,
              seating.wall, vibration.wall, vibration.time / vibration.steps,
              1e3 * vibration.wall / vibration.steps, m, n, spent);
}
} // namespace spall
