#include "carry_over.h"

#include <dem/neighbor/candidates.h>

namespace dem
{
namespace
{
PairKey key_of(const ContactBatch &batch, std::int32_t k)
{
  const auto entry = static_cast<std::size_t>(k);
  return {batch.a[entry], batch.b[entry]};
}

/// Where each of the pairs is in the batch, or -1; the others retire.
std::vector<std::int32_t> rows_in(const ContactBatch &batch,
                                  const std::vector<PairKey> &pairs,
                                  LostEnergy &retired)
{
  const std::vector<std::int32_t> sorted = batch.by_pair();
  const auto number = [&sorted](std::size_t k)
  { return static_cast<std::size_t>(sorted[k]); };
  std::vector<PairKey> keys;
  keys.reserve(sorted.size());
  for (const std::int32_t k : sorted)
    keys.push_back(key_of(batch, k));
  std::vector<std::int32_t> old_row =
      match(keys, pairs,
            [&](std::size_t k) { retire_contact(batch, number(k), retired); });
  for (std::int32_t &k : old_row)
    if (k >= 0)
      k = sorted[static_cast<std::size_t>(k)];
  return old_row;
}
} // namespace

void rebuild_pairs(const ParticleSystem &particles, const BatchLayout &layout,
                   const std::vector<PairKey> &near, ContactBatch &batch,
                   LostEnergy &retired)
{
  const bool is_damage_new = layout.has_damage && !batch.layout.has_damage;
  const std::vector<std::int32_t> old_row = rows_in(batch, near, retired);
  const std::vector<std::int32_t> order = touching_first(
      near.size(),
      [&](std::int32_t pair)
      {
        const std::int32_t k = old_row[static_cast<std::size_t>(pair)];
        return k >= 0 && batch.is_touching(static_cast<std::size_t>(k));
      });
  std::vector<std::int32_t> source;
  source.reserve(order.size());
  for (const std::int32_t pair : order)
    source.push_back(old_row[static_cast<std::size_t>(pair)]);
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

double steepness(const ParticleSystem &particles)
{
  double largest = 0.;
  for (const ParticleShape &body : particles.shape)
    largest = std::max(largest, body.max_slope / body.least_radius);
  return largest;
}
} // namespace dem
