#pragma once

#include "specimen/packing_file.h"

#include <dem/engine.h>

#include <cstdint>

/// All that the benchmark reads and writes of the engine's columns.
namespace spall
{
/// Contacts at one moment.
struct ContactCount
{
  std::int64_t pairs = 0;  ///< touching, particle on particle
  std::int64_t walls = 0;  ///< touching, particle on plane
  std::int64_t listed = 0; ///< candidate pairs

  std::int64_t touching() const { return pairs + walls; }
};

ContactCount count_contacts(const dem::Engine &engine);

/// Particles that may break.
std::size_t count_breakable(const dem::Engine &engine);

void set_velocities(dem::Engine &engine,
                    const std::vector<dem::Vec3> &velocities); ///< [m/s]

/// Positions and orientations into the packing.
void take_positions(const dem::Engine &engine, Packing &packing);

/// Sum of FNV-1a over id and position of every particle: equal on any number of
/// ranks if the positions are, bit for bit.
std::uint64_t position_checksum(const dem::Engine &engine);
} // namespace spall
