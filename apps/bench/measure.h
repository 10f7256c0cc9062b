#pragma once

#include "bench/state.h"
#include "run/rank_share.h"

namespace spall
{
/// One timed stretch of steps.
struct BenchSample
{
  int n_steps = 0;
  double wall = 0.;        ///< [s]
  double cpu = 0.;         ///< of all threads, user and system [s]
  dem::EngineClock phases; ///< wall-clock [s]
  std::int64_t n_rebuilds = 0, n_events = 0;
  ContactCount before, after;
  dem::EngineEnergy energy_before, energy_after;
  RankShare share;            ///< at the end
  std::uint64_t checksum = 0; ///< of the positions at the end

  /// Touching contacts taken through one step, by the mean of both ends.
  double updates() const
  {
    return 0.5 * n_steps *
           static_cast<double>(before.touching() + after.touching());
  }
};

BenchSample measure(dem::Engine &engine, int n_steps, double time_step);

/// Work put in less what is stored and what is lost, since the start [J].
double energy_residual(const dem::EngineEnergy &energy);
} // namespace spall
