#include "carry_over.h"

#include <dem/contact/pair_loads.h>
#include <dem/search/candidates.h>

#include <algorithm>
#include <numeric>

namespace dem
{
namespace
{
PairKey key_of(const ContactBatch &batch, std::int32_t k)
{
  const auto entry = static_cast<std::size_t>(k);
  return {batch.a[entry], batch.b[entry]};
}

/// Numbers of the contacts in the order of their keys: a counting sort by A of
/// short rows.
std::vector<std::int32_t> by_key(const ContactBatch &batch,
                                 std::size_t n_stones)
{
  std::vector<std::int32_t> start(n_stones + 1, 0);
  for (std::size_t k = 0; k < batch.size(); ++k)
    ++start[static_cast<std::size_t>(batch.a[k]) + 1];
  std::partial_sum(start.begin(), start.end(), start.begin());
  std::vector<std::int32_t> order(batch.size());
  std::vector<std::int32_t> next(start.begin(), start.end() - 1);
  for (std::size_t k = 0; k < batch.size(); ++k)
    order[static_cast<std::size_t>(
        next[static_cast<std::size_t>(batch.a[k])]++)] =
        static_cast<std::int32_t>(k);
  for (std::size_t i = 0; i < n_stones; ++i)
    std::sort(order.begin() + start[i], order.begin() + start[i + 1],
              [&batch](std::int32_t k, std::int32_t l)
              { return key_of(batch, k) < key_of(batch, l); });
  return order;
}

/// Contacts that touch before those that do not, so that blocks of open ones
/// can be passed over: window by window, so that neighbours stay near in
/// memory. The first of a range has the lowest stone and stays, see PairLoads.
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
/// Where each of the pairs is in the batch, or -1; the others retire.
std::vector<std::int32_t> places_in(const ContactBatch &batch,
                                    const std::vector<PairKey> &pairs,
                                    std::size_t n_stones, Dissipation &retired)
{
  const std::vector<std::int32_t> sorted = by_key(batch, n_stones);
  const auto number = [&sorted](std::size_t k)
  { return static_cast<std::size_t>(sorted[k]); };
  std::vector<PairKey> keys;
  keys.reserve(sorted.size());
  for (const std::int32_t k : sorted)
    keys.push_back(key_of(batch, k));
  std::vector<std::int32_t> place =
      match(keys, pairs,
            [&](std::size_t k) { retire_contact(batch, number(k), retired); });
  for (std::int32_t &k : place)
    if (k >= 0)
      k = sorted[static_cast<std::size_t>(k)];
  return place;
}
} // namespace

void rebuild_pairs(const Particles &particles, const BatchLayout &layout,
                   const std::vector<PairKey> &near, ContactBatch &batch,
                   Dissipation &retired)
{
  const bool is_damage_new = layout.has_damage && !batch.layout.has_damage;
  const std::vector<std::int32_t> place =
      places_in(batch, near, particles.size(), retired);
  const std::vector<std::int32_t> order = touching_first(
      near.size(),
      [&](std::int32_t pair)
      {
        const std::int32_t k = place[static_cast<std::size_t>(pair)];
        return k >= 0 && batch.is_touching(static_cast<std::size_t>(k));
      });
  std::vector<std::int32_t> source;
  source.reserve(order.size());
  for (const std::int32_t pair : order)
    source.push_back(place[static_cast<std::size_t>(pair)]);
  batch.rearrange(layout, source);
  for (std::size_t k = 0; k < order.size(); ++k)
  {
    const PairKey &key = near[static_cast<std::size_t>(order[k])];
    batch.a[k] = key.first;
    batch.b[k] = key.second;
  }
  if (is_damage_new)
    note_corners(particles, batch);
}
} // namespace dem
