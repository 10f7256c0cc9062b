#include "parts.h"

#include <algorithm>
#include <numeric>
#include <unordered_map>

namespace dem
{
namespace
{
template <class Call>
void visit_batches(const DistributedParts &parts, const Call &call)
{
  call(parts.pairs);
  for (const auto &boundary : parts.boundaries)
    call(boundary->batch);
}

/// Numbers of the contacts whose particle A keeps a row.
Rows kept_contacts(const ContactBatch &batch, const Rows &new_row)
{
  Rows kept;
  for (std::size_t k = 0; k < batch.size(); ++k)
    if (new_row[row_of(batch.a[k])] >= 0)
      kept.push_back(static_cast<std::int32_t>(k));
  return kept;
}

/// Calls call(partner) for the partners of all pairs.
template <class Call>
void visit_partners(const DistributedParts &parts, const Call &call)
{
  for (std::size_t k = 0; k < parts.pairs.size(); ++k)
    call(parts.pairs.b[k]);
  for (CandidatePair &pair : parts.pair_candidates)
    call(pair.key.second);
}

void sort_pairs(const DistributedParts &parts)
{
  parts.pairs.rearrange(parts.pairs.layout, parts.pairs.by_pair());
  std::ranges::sort(parts.pair_candidates, {}, &CandidatePair::key);
}
} // namespace

void name_partners_by_id(const DistributedParts &parts)
{
  visit_partners(parts,
                 [&parts](std::int32_t &partner) {
                   partner = static_cast<std::int32_t>(
                       parts.particles.id[row_of(partner)]);
                 });
}

void name_partners_by_row(const DistributedParts &parts)
{
  std::unordered_map<std::int64_t, std::int32_t> row_of_id;
  for (std::size_t i = 0; i < parts.particles.size(); ++i)
    row_of_id[parts.particles.id[i]] = static_cast<std::int32_t>(i);
  auto next = static_cast<std::int32_t>(parts.particles.size());
  visit_partners(parts,
                 [&](std::int32_t &partner)
                 {
                   const auto found = row_of_id.find(partner);
                   partner = found == row_of_id.end() ? next++ : found->second;
                 });
  sort_pairs(parts);
}

void renumber_partners(const Rows &new_row, const DistributedParts &parts)
{
  auto next = static_cast<std::int32_t>(parts.particles.size());
  visit_partners(parts,
                 [&](std::int32_t &partner)
                 {
                   const std::size_t b = row_of(partner);
                   partner = b < new_row.size() && new_row[b] >= 0 ? new_row[b]
                                                                   : next++;
                 });
  sort_pairs(parts);
}

void drop_ghosts(ParticleSystem &particles)
{
  Rows owned(particles.n_owned());
  std::iota(owned.begin(), owned.end(), 0);
  particles.n_ghosts = 0;
  particles.reorder(owned);
}

void keep_particles(const DistributedParts &parts, const Rows &order)
{
  Rows new_row(parts.particles.size(), -1);
  for (std::size_t k = 0; k < order.size(); ++k)
    new_row[row_of(order[k])] = static_cast<std::int32_t>(k);
  parts.particles.reorder(order);
  reorder_column(parts.work.damped, order);
  reorder_column(parts.work.lifted, order);
  parts.pairs = parts.pairs.select(kept_contacts(parts.pairs, new_row));
  for (const auto &boundary : parts.boundaries)
  {
    boundary->keep_contacts(kept_contacts(boundary->batch, new_row));
    boundary->keep_particles(new_row);
  }
  visit_batches(parts,
                [&new_row](ContactBatch &batch)
                {
                  for (std::size_t k = 0; k < batch.size(); ++k)
                    batch.a[k] = new_row[row_of(batch.a[k])];
                });
  visit_candidates(parts,
                   [&new_row](std::vector<CandidatePair> &candidates)
                   {
                     for (CandidatePair &pair : candidates)
                       pair.key.first = new_row[row_of(pair.key.first)];
                     std::erase_if(candidates, [](const CandidatePair &pair)
                                   { return pair.key.first < 0; });
                   });
}

void sort_by_id(const DistributedParts &parts)
{
  const std::vector<std::int64_t> &ids = parts.particles.id;
  Rows order(ids.size());
  std::iota(order.begin(), order.end(), 0);
  std::ranges::sort(order, {},
                    [&ids](std::int32_t row) { return ids[row_of(row)]; });
  keep_particles(parts, order);
  sort_pairs(parts);
  sort_contacts(parts);
}

void sort_contacts(const DistributedParts &parts)
{
  for (const auto &boundary : parts.boundaries)
    boundary->sort_contacts();
  visit_candidates(parts, [](std::vector<CandidatePair> &candidates)
                   { std::ranges::sort(candidates, {}, &CandidatePair::key); });
}
} // namespace dem
