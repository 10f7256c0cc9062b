#pragma once

#include "contact_simd.h"

/// Prefetches memory. A processor prefetches by itself in a
/// dozen columns, not in fifty, and cannot predict which particles the next
/// contacts touch. Internal to the units that are compiled once per instruction
/// set.
namespace dem::kernel
{
namespace
{
/// So many blocks are on the way: what memory answers after is some hundred
/// nanoseconds, the time of one block or two.
constexpr std::int64_t columns_ahead = 6, partners_ahead = 2;

/// Of the block from contact k, in every column.
DEM_SIMD_INLINE void fetch_columns(const ColumnsAhead &columns, std::int64_t k)
{
  for (int c = 0; c < columns.n; ++c)
    __builtin_prefetch(columns.start[c] + k * columns.entry_size[c]);
}

/// State and load of the particles B of a block from contact k.
DEM_SIMD_INLINE void fetch_partners(const Task &task, std::int64_t k)
{
  for (std::int64_t i = k; i < k + lane_block; ++i)
  {
    const double *row =
        task.particles.state + particle_row * std::int64_t{task.contacts.b[i]};
    __builtin_prefetch(row);
    __builtin_prefetch(row + particle_row / 2);
    __builtin_prefetch(partner_load(task, task.contacts.target[i]), 1);
  }
}

/// Whether the block from contact k was inactive at the check: nearly
/// always it still is, and nothing of it will be read.
DEM_SIMD_INLINE bool seems_inactive(const Task &task, std::int64_t k)
{
  const double *reactivation = task.contacts.reactivation;
  return reactivation && reactivation[k] > 0. &&
         reactivation[k + lane_block - 1] > 0.;
}

/// What the blocks after the one from contact k read; `last` ends the range.
DEM_SIMD_INLINE void fetch_ahead(const Task &task, std::int64_t k,
                                 std::int64_t last)
{
  const std::int64_t columns = k + columns_ahead * lane_block;
  if (columns + lane_block > last || !seems_inactive(task, columns))
    fetch_columns(task.ahead, columns);
  const std::int64_t partners = k + partners_ahead * lane_block;
  if (task.contacts.target && partners + lane_block <= last &&
      !seems_inactive(task, partners))
    fetch_partners(task, partners);
}
} // namespace
} // namespace dem::kernel
