#include <dem/boundary/renumber.h>

#include <algorithm>
#include <numeric>
#include <utility>

namespace dem
{
namespace
{
std::int32_t moved(const std::vector<std::int32_t> &new_row,
                   std::int32_t particle)
{
  return new_row[static_cast<std::size_t>(particle)];
}

/// Renames the particles; returns the order of the contacts by (particle,
/// part), each with its number from before.
template <class PartOf>
std::vector<std::int32_t>
renumbered_order(const std::vector<std::int32_t> &new_row, ContactBatch &batch,
                 const PartOf &part_of)
{
  std::vector<std::int32_t> order(batch.size());
  std::iota(order.begin(), order.end(), 0);
  for (std::size_t k = 0; k < batch.size(); ++k)
    batch.a[k] = moved(new_row, batch.a[k]);
  const auto key = [&](std::int32_t k)
  { return std::pair(batch.a[static_cast<std::size_t>(k)], part_of(k)); };
  std::stable_sort(order.begin(), order.end(),
                   [&key](std::int32_t k, std::int32_t l)
                   { return key(k) < key(l); });
  return order;
}
} // namespace

void renumber_planes(const std::vector<std::int32_t> &new_row,
                     ContactBatch &batch)
{
  for (std::size_t k = 0; k < batch.size(); ++k)
    batch.a[k] = moved(new_row, batch.a[k]);
  batch.rearrange(batch.layout, batch.by_pair());
}

void renumber_facets(const std::vector<std::int32_t> &new_row,
                     FacetCandidates &candidates, ContactBatch &batch)
{
  std::vector<std::int32_t> &particle = candidates.particle;
  for (std::int32_t &one : particle)
    one = moved(new_row, one);
  for (std::size_t k = 0; k < batch.size(); ++k)
    batch.a[k] = moved(new_row, batch.a[k]);
  std::vector<std::int32_t> rows(particle.size());
  std::iota(rows.begin(), rows.end(), 0);
  std::sort(rows.begin(), rows.end(),
            [&particle](std::int32_t r, std::int32_t s)
            {
              return particle[static_cast<std::size_t>(r)] <
                     particle[static_cast<std::size_t>(s)];
            });
  std::vector<std::int32_t> slots;
  slots.reserve(batch.size());
  for (const std::int32_t row : rows)
    for (std::int32_t s = 0; s < slots_per_particle; ++s)
      slots.push_back(slots_per_particle * row + s);
  reorder_column(particle, rows);
  reorder_column(candidates.contact_point, slots);
  batch.rearrange(batch.layout, slots);
  candidates.row_start.clear();
  candidates.triangle.clear();
  candidates.triangle_reactivation.clear();
  candidates.reactivation.clear();
}

void renumber_facet_contacts(const std::vector<std::int32_t> &new_row,
                             FacetCandidates &candidates, ContactBatch &batch)
{
  const std::vector<std::int32_t> order = renumbered_order(
      new_row, batch, [](std::int32_t) { return std::int32_t{0}; });
  reorder_column(candidates.contact_point, order);
  reorder_column(candidates.reactivation, order);
  batch.rearrange(batch.layout, order);
  for (std::size_t k = 0; k < order.size(); ++k)
    batch.b[k] = static_cast<std::int32_t>(k);
}
} // namespace dem
