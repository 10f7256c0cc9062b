#pragma once

#include <dem/engine.h>

#include <cstdint>

namespace spall
{
/// Contacts at one moment.
struct ContactCount
{
  std::int64_t pairs = 0;  ///< touching, stone on stone
  std::int64_t walls = 0;  ///< touching, stone on plane
  std::int64_t listed = 0; ///< candidate pairs

  std::int64_t touching() const { return pairs + walls; }
};

ContactCount count_contacts(const dem::Engine &engine);

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
  std::uint64_t checksum = 0; ///< of the positions at the end

  /// Touching contacts taken through one step, by the mean of both ends.
  double updates() const
  {
    return 0.5 * n_steps *
           static_cast<double>(before.touching() + after.touching());
  }
};

BenchSample measure(dem::Engine &engine, int n_steps, double time_step);

/// FNV-1a over the bytes of all positions: equal if they are, bit for bit.
std::uint64_t position_checksum(const dem::Engine &engine);

/// Work put in less what is stored and what is lost, since the start [J].
double energy_residual(const dem::EngineEnergy &energy);

/// Memory of the program.
struct MemoryUse
{
  double now = 0.;  ///< resident [bytes]
  double peak = 0.; ///< resident, highest so far [bytes]
};

MemoryUse memory_use();
} // namespace spall
