#pragma once

#include <dem/contact/batch.h>
#include <dem/particles.h>
#include <dem/search/near_pairs.h>

namespace dem
{
/// What the springs of a touching contact hold is lost when it is dropped.
void retire_contact(const ContactBatch &batch, std::size_t k,
                    Dissipation &retired);

/// Marks the corners that the sides know of; what is stored now has counted.
void note_corners(const Particles &particles, ContactBatch &batch);

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
} // namespace dem
