#pragma once

#include <dem/contact/batch.h>
#include <dem/contact/lost_energy.h>
#include <dem/contact/pair_loads.h>
#include <dem/neighbor/near_pairs.h>
#include <dem/particles/particle_system.h>

#include <algorithm>
#include <numeric>

namespace dem
{
/// What the springs of a touching contact hold is lost when it is dropped.
void retire_contact(const ContactBatch &batch, std::size_t k,
                    LostEnergy &retired);

/// Marks the corners stored by the sides; they have been counted.
void note_corners(const ParticleSystem &particles, ContactBatch &batch);

/// Calls retire(old) for every entry of `old_keys` that `keys` lacks; returns
/// where each of `keys` was, or -1. Both are sorted.
template <class Retire>
std::vector<std::int32_t> match(const std::vector<PairKey> &old_keys,
                                const std::vector<PairKey> &keys,
                                const Retire &retire)
{
  std::vector<std::int32_t> source(keys.size(), -1);
  std::size_t old = 0;
  for (std::size_t k = 0; k < keys.size(); ++k)
  {
    for (; old < old_keys.size() && old_keys[old] < keys[k]; ++old)
      retire(old);
    if (old < old_keys.size() && old_keys[old] == keys[k])
      source[k] = static_cast<std::int32_t>(old++);
  }
  for (; old < old_keys.size(); ++old)
    retire(old);
  return source;
}

/// Contacts that touch before those that do not, so that blocks of open ones
/// can be passed over: window by window, so that neighbours stay near in
/// memory. The first of a range has the lowest particle and stays, see
/// PairLoads.
template <class Touches>
std::vector<std::int32_t> touching_first(std::size_t n, const Touches &touches)
{
  constexpr std::int64_t window = 512;
  std::vector<std::int32_t> order(n);
  std::iota(order.begin(), order.end(), 0);
  const auto end = static_cast<std::int64_t>(n);
  const std::int64_t range = range_size(end);
  for (std::int64_t first = 0; first < end; first += range)
  {
    const std::int64_t last = std::min(first + range, end);
    for (std::int64_t from = first; from < last; from += window)
      std::stable_partition(order.begin() + std::max(from, first + 1),
                            order.begin() + std::min(from + window, last),
                            touches);
  }
  return order;
}
} // namespace dem
