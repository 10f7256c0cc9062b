#include "../contact/follow.h"
#include "carry_over.h"

#include <dem/search/spot_lists.h>

#include <algorithm>
#include <utility>

namespace dem
{
namespace
{
/// Gaps beyond so many margins need not be known better.
constexpr double far_margins = 3.;

/// One entry of the list to be.
struct Row
{
  std::int32_t source = -1; ///< where it was, -1: new
  Spot spot;                ///< on a wall only `on_a`
};

/// Entries of one pair as they were: [first, last).
struct OldRows
{
  std::size_t first = 0, last = 0;
};

/// Finds the entries of keys that come in rising order.
class OldList
{
public:
  explicit OldList(const ContactBatch &sorted) : batch(sorted) {}

  OldRows next(const PairKey &key)
  {
    while (at < batch.size() && key_of(at) < key)
      ++at;
    const std::size_t first = at;
    while (at < batch.size() && key_of(at) == key)
      ++at;
    return {first, at};
  }

private:
  PairKey key_of(std::size_t k) const { return {batch.a[k], batch.b[k]}; }

  const ContactBatch &batch;
  std::size_t at = 0;
};

/// The list of one pair while it is made.
struct PairList
{
  std::vector<Row> rows;
  double clear = 0.;           ///< travel up to which the list is complete [m]
  Vec3 between = Vec3::Zero(); ///< WatchedPair::between
  bool is_new = true;          ///< else all rows stay as they are
  SpotEvents events;

  std::vector<Spot> spots() const
  {
    std::vector<Spot> all;
    for (const Row &row : rows)
      all.push_back(row.spot);
    return all;
  }

  /// Keeps an old contact unless one that is kept is at its place.
  void keep(const Row &row)
  {
    const bool is_double = std::any_of(
        rows.begin(), rows.end(),
        [&](const Row &other) { return is_one_place(row.spot, other.spot); });
    if (is_double)
      ++events.n_merged;
    else
      rows.push_back(row);
  }

  /// Adds new contacts, the nearest first.
  void add(const std::vector<Spot> &found, bool is_first)
  {
    for (const Spot &spot : found)
    {
      if (rows.size() >= most_spots)
      {
        ++events.n_unlisted;
        continue;
      }
      events.n_late += spot.overlap > 0. && !is_first;
      rows.push_back({-1, spot});
    }
  }
};

/// A contact that has come to another place, or lost its own.
bool has_strayed(const ContactBatch &batch, std::size_t k)
{
  return batch.strayed[k] != 0 || batch.slack[k] >= kernel::closed_slack;
}

/// Touching contacts come first: of two at one place the other one goes.
std::vector<std::size_t> alive_first(const ContactBatch &batch,
                                     const OldRows &old)
{
  std::vector<std::size_t> alive;
  for (const bool is_touching : {true, false})
    for (std::size_t k = old.first; k < old.last; ++k)
      if (batch.is_touching(k) == is_touching &&
          batch.slack[k] < kernel::closed_slack)
        alive.push_back(k);
  return alive;
}

/// A pair that needs no search.
PairList unchanged(const OldRows &old)
{
  PairList list;
  list.is_new = false;
  for (std::size_t k = old.first; k < old.last; ++k)
    list.rows.push_back({static_cast<std::int32_t>(k), {}});
  return list;
}

/// Gap between the points of two surfaces where an old contact is [m].
double gap_at(const Particles &particles, const PairKey &pair,
              const RelativePose &pose, const Spot &spot)
{
  const SurfacePoint a =
      surface_point(particles.body[row_of(pair.first)], spot.on_a);
  const SurfacePoint b =
      surface_point(particles.body[row_of(pair.second)], spot.on_b);
  return (pose.position + pose.rotation * b.position - a.position)
      .dot(a.normal);
}

PairList list_pair(const SpotSearchInput &input, const WatchedPair &watched,
                   const ContactBatch &batch, const OldRows &old)
{
  const Particles &particles = input.context.particles;
  const PairKey &pair = watched.key;
  const RelativePose pose =
      relative_pose(particles, row_of(pair.first), row_of(pair.second));
  const MappedPair mapped{input.maps.stone(particles, row_of(pair.first)),
                          input.maps.stone(particles, row_of(pair.second)),
                          pose};
  const Separation separation =
      separate(mapped, watched.between.isZero(0.) ? pose.position.normalized()
                                                  : watched.between);
  PairList list;
  list.between = separation.normal;
  list.clear = std::max(separation.gap, input.margin);
  if (separation.gap > input.margin)
    return list;
  list.events.n_scans = 1;
  for (const std::size_t k : alive_first(batch, old))
  {
    const Spot spot = spot_of(batch, k);
    if (batch.is_touching(k) ||
        gap_at(particles, pair, pose, spot) < input.margin)
      list.keep({static_cast<std::int32_t>(k), spot});
  }
  const SpotSearch search =
      find_spots(mapped, separation, input.margin, list.spots());
  list.events.n_lost = search.n_lost;
  list.add(search.spots, input.is_first);
  return list;
}

PairList list_support(const SpotSearchInput &input, const PairKey &key,
                      const Plane &plane, const ContactBatch &batch,
                      const OldRows &old)
{
  const Particles &particles = input.context.particles;
  const std::size_t i = row_of(key.first);
  const Vec3 normal = particles.orientation(i).conjugate() * -plane.normal;
  const double distance =
      (particles.position(i) - plane.point).dot(plane.normal);
  PairList list;
  list.clear =
      std::max(input.margin, distance - particles.body[i].circumscribed_radius);
  list.events.n_scans = 1;
  for (const std::size_t k : alive_first(batch, old))
  {
    const Spot spot{batch.side_a.spot(k), Vec3::UnitZ(), 0., true};
    const double height =
        surface_point(particles.body[i], spot.on_a).position.dot(normal);
    if (batch.is_touching(k) || distance - height < input.margin)
      list.keep({static_cast<std::int32_t>(k), spot});
  }
  if (list.clear == input.margin)
    list.add(find_supports(input.maps.stone(particles, i), normal,
                           {distance - input.margin, distance}, list.spots()),
             input.is_first);
  return list;
}

/// Makes the lists of all pairs: `make(pair, old)` that of one which is due.
template <class Make>
std::vector<PairList> make_lists(const std::vector<WatchedPair> &pairs,
                                 const ContactBatch &batch, const Make &make)
{
  OldList old_list(batch);
  std::vector<OldRows> old;
  old.reserve(pairs.size());
  for (const WatchedPair &pair : pairs)
    old.push_back(old_list.next(pair.key));
  std::vector<PairList> lists(pairs.size());
#pragma omp parallel for schedule(dynamic, 16)
  for (std::size_t p = 0; p < pairs.size(); ++p)
    lists[p] = make(pairs[p], old[p]);
  return lists;
}

bool have_strayed(const ContactBatch &batch, const OldRows &old)
{
  for (std::size_t k = old.first; k < old.last; ++k)
    if (has_strayed(batch, k))
      return true;
  return false;
}

bool has_open_places(const ContactBatch &batch, const OldRows &old)
{
  for (std::size_t k = old.first; k < old.last; ++k)
    if (!batch.is_touching(k))
      return true;
  return false;
}

/// Places of the entries as they will stand, in the order of the pairs.
struct Arrangement
{
  std::vector<std::int32_t> source;
  std::vector<PairKey> key;
  std::vector<const Row *> row;

  Arrangement(const std::vector<WatchedPair> &pairs,
              const std::vector<PairList> &lists)
  {
    for (std::size_t p = 0; p < pairs.size(); ++p)
      for (const Row &one : lists[p].rows)
      {
        source.push_back(one.source);
        key.push_back(pairs[p].key);
        row.push_back(&one);
      }
  }

  bool changes(const ContactBatch &batch) const
  {
    if (source.size() != batch.size())
      return true;
    for (std::size_t k = 0; k < source.size(); ++k)
      if (source[k] != static_cast<std::int32_t>(k))
        return true;
    return false;
  }
};

/// Gives up what the dropped contacts hold.
void retire_dropped(const Arrangement &to, const ContactBatch &batch,
                    Dissipation &retired)
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
void arrange(const SpotSearchInput &input, const Arrangement &to,
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
    batch.strayed[k] = 0;
    if (to.source[k] >= 0)
      continue;
    const Spot &spot = to.row[k]->spot;
    if (input.layout.has_partners)
      place_pair(input.context, batch, k, spot);
    else
      renew_side(input.context, batch, k, true, spot.on_a);
    batch.slack[k] = input.is_first ? 0. : std::max(0., spot.overlap);
  }
  if (is_damage_new)
    note_corners(input.context.particles, batch);
}

/// Which layout the batch has, as far as the lists set it.
bool is_same_layout(const BatchLayout &one, const BatchLayout &other)
{
  return one.has_rolling == other.has_rolling &&
         one.has_damage == other.has_damage && one.has_spots == other.has_spots;
}

/// The pairs that bounding spheres allow, with what is known of them.
std::vector<WatchedPair> merged(const std::vector<PairKey> &keys,
                                const std::vector<WatchedPair> &known)
{
  std::vector<WatchedPair> pairs;
  pairs.reserve(keys.size());
  auto old = known.begin();
  for (const PairKey &key : keys)
  {
    while (old != known.end() && old->key < key)
      ++old;
    const bool is_known = old != known.end() && old->key == key;
    pairs.push_back(is_known ? *old : WatchedPair{key, -1., 0., Vec3::Zero()});
  }
  return pairs;
}

/// Makes the lists that are due and puts the batch in their order.
template <class Travelled, class Make>
SpotEvents renew(const SpotSearchInput &input, std::vector<WatchedPair> &pairs,
                 const Travelled &travelled, const Make &make,
                 ContactBatch &batch, Dissipation &retired)
{
  const std::vector<PairList> lists = make_lists(
      pairs, batch,
      [&](const WatchedPair &pair, const OldRows &old)
      {
        const bool is_due =
            pair.due < travelled(pair.key) + input.notice ||
            have_strayed(batch, old) ||
            (pair.margin > 2. * input.margin && has_open_places(batch, old));
        return is_due ? make(pair, old) : unchanged(old);
      });
  SpotEvents events;
  for (std::size_t p = 0; p < pairs.size(); ++p)
  {
    events += lists[p].events;
    if (lists[p].is_new)
    {
      pairs[p].due = travelled(pairs[p].key) + lists[p].clear;
      pairs[p].margin = input.margin;
      pairs[p].between = lists[p].between;
    }
  }
  const Arrangement to(pairs, lists);
  if (!to.changes(batch) && is_same_layout(input.layout, batch.layout))
  {
    std::fill(batch.strayed.begin(), batch.strayed.end(), std::uint8_t{0});
    return events;
  }
  retire_dropped(to, batch, retired);
  arrange(input, to, batch);
  return events;
}
} // namespace

SpotEvents &SpotEvents::operator+=(const SpotEvents &part)
{
  n_scans += part.n_scans;
  n_late += part.n_late;
  n_jumps += part.n_jumps;
  n_ended += part.n_ended;
  n_merged += part.n_merged;
  n_unlisted += part.n_unlisted;
  n_lost += part.n_lost;
  return *this;
}

void SpotLists::renew_pairs(const SpotSearchInput &input, const Travel &travel,
                            ContactBatch &batch, Dissipation &retired)
{
  const Particles &particles = input.context.particles;
  const double range = far_margins * input.margin;
  if (reach < travel.centres + input.margin)
  {
    pairs = merged(near_spheres(particles, range), pairs);
    reach = travel.centres + range;
  }
  events += renew(
      input, pairs,
      [&particles](const PairKey &key)
      {
        return particles.travelled[row_of(key.first)] +
               particles.travelled[row_of(key.second)];
      },
      [&](const WatchedPair &pair, const OldRows &old)
      { return list_pair(input, pair, batch, old); },
      batch, retired);
}

void SpotLists::renew_planes(const SpotSearchInput &input,
                             const std::vector<Plane> &planes,
                             double planes_travelled, ContactBatch &batch,
                             Dissipation &retired)
{
  const Particles &particles = input.context.particles;
  std::vector<PairKey> keys;
  for (std::size_t i = 0; i < particles.size(); ++i)
    for (std::size_t p = 0; p < planes.size(); ++p)
      if (planes[p].is_active &&
          (particles.position(i) - planes[p].point).dot(planes[p].normal) <
              particles.body[i].circumscribed_radius +
                  far_margins * input.margin)
        keys.emplace_back(static_cast<std::int32_t>(i),
                          static_cast<std::int32_t>(p));
  supports = merged(keys, supports);
  events += renew(
      input, supports,
      [&](const PairKey &key)
      { return particles.travelled[row_of(key.first)] + planes_travelled; },
      [&](const WatchedPair &pair, const OldRows &old)
      {
        return list_support(input, pair.key, planes[row_of(pair.key.second)],
                            batch, old);
      },
      batch, retired);
}

void SpotLists::renumber(const std::vector<std::int32_t> &place)
{
  const auto by_key = [](const WatchedPair &one, const WatchedPair &other)
  { return one.key < other.key; };
  for (WatchedPair &pair : pairs)
  {
    const std::int32_t a = place[row_of(pair.key.first)],
                       b = place[row_of(pair.key.second)];
    // The first stone may be another one.
    pair.between = Vec3::Zero();
    pair.key = std::minmax(a, b);
  }
  for (WatchedPair &pair : supports)
    pair.key.first = place[row_of(pair.key.first)];
  std::sort(pairs.begin(), pairs.end(), by_key);
  std::sort(supports.begin(), supports.end(), by_key);
}
} // namespace dem
