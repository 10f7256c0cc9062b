#pragma once

#include "../contact/follow.h"
#include "carry_over.h"

#include <dem/contact/lost_energy.h>
#include <dem/contact/wall_contact_point.h>
#include <dem/neighbor/contact_point_lists.h>

#include <algorithm>
#include <numeric>
#include <span>
#include <utility>

/// Lists of contact points by pair of bodies: what those of particles and of
/// walls have in common.
namespace dem
{
namespace
{
/// Gaps beyond so many times the skin need not be known better.
constexpr double far_skins = 3.;

/// One entry of the list to be.
struct Row
{
  std::int32_t source = -1;   ///< where it was, -1: new
  ContactPoint contact_point; ///< on a wall only `on_a`
  WallContactPoint foot;      ///< on drums and facets: point, normal, triangle
};

/// Numbers of the entries of one pair as they were.
using OldRows = std::span<const std::int32_t>;

/// What the entries of a batch are listed by: `b`, or what it stands for.
using SecondOf = std::int32_t (*)(std::int32_t b);

/// Finds the entries of keys that come in rising order.
class OldList
{
public:
  /// `in_order`: their numbers by key.
  OldList(const ContactBatch &its_batch, SecondOf second_body, OldRows in_order)
      : batch(its_batch), second_of(second_body), order(in_order)
  {
  }

  OldRows next(const PairKey &key)
  {
    while (at < order.size() && key_of(at) < key)
      ++at;
    const std::size_t first = at;
    while (at < order.size() && key_of(at) == key)
      ++at;
    return order.subspan(first, at - first);
  }

private:
  PairKey key_of(std::size_t index) const
  {
    const std::size_t k = row_of(order[index]);
    return {batch.a[k], second_of(batch.b[k])};
  }

  const ContactBatch &batch;
  SecondOf second_of;
  OldRows order;
  std::size_t at = 0;
};

/// The list of one pair while it is made.
struct PairList
{
  std::vector<Row> rows;
  double clear = 0.; ///< path length up to which the list is complete [m]
  Vec3 between = Vec3::Zero(); ///< CandidatePair::between
  ContactPointEvents events;

  std::vector<ContactPoint> contact_points() const
  {
    std::vector<ContactPoint> all;
    for (const Row &row : rows)
      all.push_back(row.contact_point);
    return all;
  }

  /// Two contacts at the same contact point: on walls beside each other on the
  /// particle, and of one patch.
  static bool is_double(const Row &one, const Row &other)
  {
    return is_one_contact_point(one.contact_point, other.contact_point) &&
           is_one_patch(one.foot.normal, other.foot.normal);
  }

  /// Keeps an old contact unless another one is at the same contact point.
  template <class IsDouble>
  void keep(const Row &row, const IsDouble &is_double_of)
  {
    if (std::any_of(rows.begin(), rows.end(),
                    [&](const Row &other) { return is_double_of(row, other); }))
      ++events.n_merged;
    else
      rows.push_back(row);
  }
  void keep(const Row &row) { keep(row, is_double); }

  /// Adds new contacts. Of too many the farthest go, be they new or old, and
  /// the list is complete until those could touch.
  void add(const std::vector<ContactPoint> &found, bool is_first)
  {
    for (const ContactPoint &contact_point : found)
      rows.push_back({-1, contact_point, {}});
    while (rows.size() > most_contact_points)
    {
      const auto farthest = std::ranges::min_element(
          rows, {}, [](const Row &row) { return row.contact_point.overlap; });
      clear = std::min(clear, std::max(0., -farthest->contact_point.overlap));
      rows.erase(farthest);
      ++events.n_unlisted;
    }
    for (const Row &row : rows)
      events.n_late +=
          row.source < 0 && row.contact_point.overlap > 0. && !is_first;
  }
};

/// A contact that has come to another contact point, or lost its own.
inline bool has_displaced(const ContactBatch &batch, std::size_t k)
{
  return batch.displaced[k] != 0 && !batch.is_vacant(k);
}

/// Touching contacts come first: of two at one contact point the second is
/// removed.
inline std::vector<std::size_t> alive_first(const ContactBatch &batch,
                                            const OldRows &old)
{
  std::vector<std::size_t> alive;
  for (const bool is_touching : {true, false})
    for (const std::int32_t entry : old)
      if (const std::size_t k = row_of(entry);
          batch.is_touching(k) == is_touching &&
          batch.overlap_offset[k] < kernel::closed_offset)
        alive.push_back(k);
  return alive;
}

/// Pairs with what they had, and the new lists of those that are due.
struct Renewal
{
  std::vector<OldRows> old;     ///< of every pair
  std::vector<std::size_t> due; ///< numbers of pairs, rising
  std::vector<PairList> lists;  ///< of these

  /// Whether some entry of a batch of this size comes, goes or moves.
  bool changes(std::size_t n_entries) const
  {
    std::size_t n_old = 0;
    for (const OldRows &rows : old)
      n_old += rows.size();
    if (n_old != n_entries)
      return true;
    for (std::size_t d = 0; d < due.size(); ++d)
      if (!std::ranges::equal(lists[d].rows, old[due[d]], {}, &Row::source))
        return true;
    return false;
  }
};

/// What every pair has.
inline std::vector<OldRows> old_rows(const std::vector<CandidatePair> &pairs,
                                     OldList old_list)
{
  std::vector<OldRows> old;
  old.reserve(pairs.size());
  for (const CandidatePair &pair : pairs)
    old.push_back(old_list.next(pair.key));
  return old;
}

/// Makes the lists of the pairs for which is_due(pair, old rows) holds:
/// `make(pair, old rows)`.
template <class IsDue, class Make>
Renewal renew_lists(const std::vector<CandidatePair> &pairs,
                    const OldList &old_list, const IsDue &is_due,
                    const Make &make)
{
  Renewal made;
  made.old = old_rows(pairs, old_list);
  std::vector<std::uint8_t> wants(pairs.size());
#pragma omp parallel for schedule(static)
  for (std::size_t p = 0; p < pairs.size(); ++p)
    wants[p] = is_due(pairs[p], made.old[p]) ? 1 : 0;
  for (std::size_t p = 0; p < pairs.size(); ++p)
    if (wants[p])
      made.due.push_back(p);
  made.lists.resize(made.due.size());
#pragma omp parallel for schedule(dynamic, 4)
  for (std::size_t d = 0; d < made.due.size(); ++d)
    made.lists[d] = make(pairs[made.due[d]], made.old[made.due[d]]);
  return made;
}

inline bool have_displaced(const ContactBatch &batch, const OldRows &old)
{
  for (const std::int32_t k : old)
    if (has_displaced(batch, row_of(k)))
      return true;
  return false;
}

inline bool has_open_contacts(const ContactBatch &batch, const OldRows &old)
{
  for (const std::int32_t k : old)
    if (!batch.is_touching(row_of(k)))
      return true;
  return false;
}

/// Rows of the entries after the update, in the order of the pairs until
/// they are put in another one.
struct Arrangement
{
  std::vector<std::int32_t> source;
  std::vector<PairKey> key;
  std::vector<const Row *> row;

  Arrangement(const std::vector<CandidatePair> &pairs, const Renewal &made)
  {
    static const Row kept;
    std::size_t next = 0;
    for (std::size_t p = 0; p < pairs.size(); ++p)
      if (next < made.due.size() && made.due[next] == p)
        for (const Row &one : made.lists[next++].rows)
          add(one.source, pairs[p].key, one);
      else
        for (const std::int32_t k : made.old[p])
          add(k, pairs[p].key, kept);
  }

  void add(std::int32_t from, const PairKey &pair, const Row &one)
  {
    source.push_back(from);
    key.push_back(pair);
    row.push_back(&one);
  }

  /// Those that touch before those that do not, see touching_first().
  void put_touching_first(const ContactBatch &batch)
  {
    const std::vector<std::int32_t> order =
        touching_first(source.size(),
                       [&](std::int32_t k)
                       {
                         const std::int32_t from = source[row_of(k)];
                         return from >= 0 && batch.is_touching(row_of(from));
                       });
    reorder_column(source, order);
    reorder_column(key, order);
    reorder_column(row, order);
  }
};

/// Releases the energy of the dropped contacts.
inline void retire_dropped(const Arrangement &to, const ContactBatch &batch,
                           LostEnergy &retired)
{
  std::vector<std::uint8_t> is_kept(batch.size(), 0);
  for (const std::int32_t source : to.source)
    if (source >= 0)
      is_kept[row_of(source)] = 1;
  for (std::size_t k = 0; k < batch.size(); ++k)
    if (!is_kept[k])
      retire_contact(batch, k, retired);
}

/// Puts the batch in the order of the lists and evaluates new sides.
inline void arrange(const ContactPointSearchInput &input, const Arrangement &to,
                    ContactBatch &batch)
{
  const bool is_damage_new =
      input.layout.has_damage && !batch.layout.has_damage;
  batch.rearrange(input.layout, to.source);
  const auto n = static_cast<std::int64_t>(to.source.size());
#pragma omp parallel for schedule(dynamic, 64)
  for (std::int64_t entry = 0; entry < n; ++entry)
  {
    const auto k = static_cast<std::size_t>(entry);
    batch.a[k] = to.key[k].first;
    batch.b[k] = to.key[k].second;
    batch.displaced[k] = 0;
    if (to.source[k] >= 0)
      continue;
    const ContactPoint &contact_point = to.row[k]->contact_point;
    if (input.layout.has_partners)
      renew_sides(input.context, batch, k, contact_point);
    else
      renew_side(input.context, batch, k, true, contact_point.on_a);
    batch.overlap_offset[k] =
        input.is_first ? 0. : std::max(0., contact_point.overlap);
  }
  if (is_damage_new)
    note_corners(input.context.particles, batch);
}

/// Which layout the batch has, as far as the lists set it.
inline bool is_same_layout(const BatchLayout &one, const BatchLayout &other)
{
  return one.has_rolling == other.has_rolling &&
         one.has_damage == other.has_damage &&
         one.has_reversal == other.has_reversal &&
         one.has_peak == other.has_peak &&
         one.has_contact_points == other.has_contact_points;
}

/// The pairs that bounding spheres allow, with what is known of them.
inline std::vector<CandidatePair>
merged(const std::vector<PairKey> &keys,
       const std::vector<CandidatePair> &known)
{
  std::vector<CandidatePair> pairs;
  pairs.reserve(keys.size());
  auto old = known.begin();
  for (const PairKey &key : keys)
  {
    while (old != known.end() && old->key < key)
      ++old;
    const bool is_known = old != known.end() && old->key == key;
    pairs.push_back(is_known ? *old
                             : CandidatePair{key, -1., 0., Vec3::Zero()});
  }
  return pairs;
}

/// Pairs that may touch, with the path length of each, and what is listed
/// by.
template <class Path>
struct CandidateList
{
  std::vector<CandidatePair> &pairs;
  Path path_length;
  SecondOf second_of;
};
// Clang 14 deduces no arguments of an aggregate without a guide.
template <class Path>
CandidateList(std::vector<CandidatePair> &, Path, SecondOf)
    -> CandidateList<Path>;

/// `b` is the particle or the plane itself.
inline std::int32_t itself(std::int32_t b)
{
  return b;
}

/// Notes of the pairs that got new lists what these are good for.
template <class Path>
ContactPointEvents note_lists(const ContactPointSearchInput &input,
                              const Renewal &made, const Path &path_length,
                              std::vector<CandidatePair> &pairs)
{
  ContactPointEvents events;
  for (std::size_t d = 0; d < made.due.size(); ++d)
  {
    CandidatePair &pair = pairs[made.due[d]];
    events += made.lists[d].events;
    pair.due = path_length(pair.key) + made.lists[d].clear;
    pair.skin = input.skin;
    pair.between = made.lists[d].between;
  }
  return events;
}

/// Puts the batch in the order of the lists.
inline Arrangement arrange_anew(const ContactPointSearchInput &input,
                                const std::vector<CandidatePair> &pairs,
                                const Renewal &made, ContactBatch &batch,
                                LostEnergy &retired)
{
  Arrangement to(pairs, made);
  if (input.layout.has_partners)
    to.put_touching_first(batch);
  retire_dropped(to, batch, retired);
  arrange(input, to, batch);
  return to;
}

/// Makes the lists that are due and puts the batch in their order, then calls
/// arranged(Arrangement) if that is another one.
template <class Path, class Make, class Arranged>
ContactPointEvents renew(const ContactPointSearchInput &input,
                         const CandidateList<Path> &candidates,
                         const Make &make, ContactBatch &batch,
                         LostEnergy &retired, const Arranged &arranged)
{
  std::vector<CandidatePair> &pairs = candidates.pairs;
  const std::vector<std::int32_t> old_order = batch.by_pair();
  const Renewal made = renew_lists(
      pairs, OldList(batch, candidates.second_of, old_order),
      [&](const CandidatePair &pair, const OldRows &old)
      {
        return pair.due < candidates.path_length(pair.key) + input.notice ||
               have_displaced(batch, old) ||
               (pair.skin > 2. * input.skin && has_open_contacts(batch, old));
      },
      make);
  const ContactPointEvents events =
      note_lists(input, made, candidates.path_length, pairs);
  if (!made.changes(batch.size()) && is_same_layout(input.layout, batch.layout))
    std::fill(batch.displaced.begin(), batch.displaced.end(), std::uint8_t{0});
  else
    arranged(arrange_anew(input, pairs, made, batch, retired));
  return events;
}
} // namespace
} // namespace dem
