#pragma once

#include "point_list_renewal.h"

#include <map>
#include <optional>

/// Some pairs get new lists while the batch stays as it stands: what a step
/// costs goes with the contacts that displaced, not with all of them.
namespace dem
{
namespace
{
/// The contacts of all pairs of which one has displaced, by pair.
inline std::vector<std::int32_t> of_displaced_pairs(const ContactBatch &batch)
{
  std::vector<PairKey> keys;
  for (std::size_t k = 0; k < batch.size(); ++k)
    if (has_displaced(batch, k))
      keys.push_back({batch.a[k], batch.b[k]});
  std::ranges::sort(keys);
  std::vector<std::int32_t> contacts;
  if (keys.empty())
    return contacts;
  std::vector<std::uint8_t> is_first(row_of(keys.back().first) + 1, 0);
  for (const PairKey &key : keys)
    is_first[row_of(key.first)] = 1;
  for (std::size_t k = 0; k < batch.size(); ++k)
    if (const std::size_t a = row_of(batch.a[k]);
        a < is_first.size() && is_first[a] && !batch.is_vacant(k) &&
        std::ranges::binary_search(keys, PairKey{batch.a[k], batch.b[k]}))
      contacts.push_back(static_cast<std::int32_t>(k));
  batch.sort_by_pair(contacts);
  return contacts;
}

/// A new contact and the entry that it takes.
struct Added
{
  std::size_t entry = 0;
  std::int32_t target = 0; ///< as that of the pair's old ones in this range
  PairKey key{};
  const ContactPoint *contact_point = nullptr;
};

/// What a renewal does to entries that stay in their ranges, see PairLoads.
class LocalChanges
{
public:
  LocalChanges(const std::vector<CandidatePair> &its_pairs,
               const Renewal &its_lists, const ContactBatch &its_batch)
      : pairs(its_pairs), made(its_lists), batch(its_batch),
        range(static_cast<std::size_t>(
            range_size(static_cast<std::int64_t>(batch.size()))))
  {
    for (std::size_t d = 0; d < made.due.size(); ++d)
      find_dropped(made.old[made.due[d]], made.lists[d].rows);
    for (std::size_t d = 0; d < made.due.size(); ++d)
      add_new(pairs[made.due[d]].key, made.old[made.due[d]],
              made.lists[d].rows);
  }

  bool has_room() const { return !is_full; }
  const std::vector<std::size_t> &dropped() const { return gone; }
  const std::vector<Added> &added() const { return come; }

private:
  void find_dropped(const OldRows &old, const std::vector<Row> &rows)
  {
    for (const std::int32_t k : old)
      if (std::ranges::find(rows, k, &Row::source) == rows.end())
      {
        gone.push_back(row_of(k));
        vacant_of(row_of(k) / range).push_back(row_of(k));
      }
  }

  void add_new(const PairKey &key, const OldRows &old,
               const std::vector<Row> &rows)
  {
    for (const Row &row : rows)
      if (row.source < 0)
      {
        const std::size_t near = row_of(old.front());
        if (const std::optional<std::size_t> entry = take(near))
          come.push_back({*entry, batch.target[near], key, &row.contact_point});
        else
          is_full = true;
      }
  }

  /// A vacant entry of the range of this contact. The first of a range keeps
  /// its particle.
  std::optional<std::size_t> take(std::size_t near)
  {
    std::vector<std::size_t> &there = vacant_of(near / range);
    const auto found = std::ranges::find_if(
        there, [&](std::size_t k)
        { return k % range != 0 || batch.a[k] == batch.a[near]; });
    if (found == there.end())
      return {};
    const std::size_t entry = *found;
    there.erase(found);
    return entry;
  }

  std::vector<std::size_t> &vacant_of(std::size_t number)
  {
    const auto [at, is_new] = vacant.try_emplace(number);
    if (is_new)
      for (std::size_t k = number * range;
           k < std::min(batch.size(), (number + 1) * range); ++k)
        if (batch.is_vacant(k))
          at->second.push_back(k);
    return at->second;
  }

  const std::vector<CandidatePair> &pairs;
  const Renewal &made;
  const ContactBatch &batch;
  std::size_t range;
  bool is_full = false;
  std::vector<std::size_t> gone;
  std::vector<Added> come;
  std::map<std::size_t, std::vector<std::size_t>> vacant; ///< by range
};

inline void carry_out(const ContactPointSearchInput &input,
                      const LocalChanges &all, ContactBatch &batch,
                      LostEnergy &retired)
{
  for (const std::size_t k : all.dropped())
  {
    retire_contact(batch, k, retired);
    batch.vacate(k);
  }
  for (const Added &one : all.added())
  {
    batch.start(one.entry, one.key.first, one.key.second);
    batch.target[one.entry] = one.target;
    renew_sides(input.context, batch, one.entry, *one.contact_point);
    batch.overlap_offset[one.entry] = std::max(0., one.contact_point->overlap);
  }
}
} // namespace
} // namespace dem
