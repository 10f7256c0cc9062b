#include "local_renewal.h"

#include <algorithm>

namespace dem
{
namespace
{
/// Particles are searched for contact points within so many times the skin:
/// what is not listed yet limits the validity of the list.
constexpr double reach_skins = 2.;

/// Gap between the points of two surfaces where an old contact is [m].
double gap_at(const ParticleSystem &particles, const PairKey &pair,
              const RelativePose &pose, const ContactPoint &contact_point)
{
  const SurfacePoint a =
      surface_point(particles.shape[row_of(pair.first)], contact_point.on_a);
  const SurfacePoint b =
      surface_point(particles.shape[row_of(pair.second)], contact_point.on_b);
  return (pose.position + pose.rotation * b.position - a.position)
      .dot(a.normal);
}

PairList list_pair(const ContactPointSearchInput &input,
                   const CandidatePair &candidates, const ContactBatch &batch,
                   const OldRows &old)
{
  const ParticleSystem &particles = input.context.particles;
  const PairKey &pair = candidates.key;
  const RelativePose pose =
      relative_pose(particles, row_of(pair.first), row_of(pair.second));
  const MappedPair mapped{input.maps.particle(particles, row_of(pair.first)),
                          input.maps.particle(particles, row_of(pair.second)),
                          pose};
  const Separation separation =
      separate(mapped,
               candidates.between.isZero(0.) ? pose.position.normalized()
                                             : candidates.between,
               input.skin);
  PairList list;
  list.between = separation.normal;
  list.clear = std::max(separation.gap, input.skin);
  if (separation.gap > input.skin)
    return list;
  list.events.n_scans = 1;
  for (const std::size_t k : alive_first(batch, old))
  {
    ContactPoint contact_point = contact_point_of(batch, k);
    contact_point.overlap = batch.is_touching(k)
                                ? batch.overlap[k]
                                : -gap_at(particles, pair, pose, contact_point);
    if (contact_point.overlap > -input.skin)
      list.keep({static_cast<std::int32_t>(k), contact_point, {}});
  }
  ContactPointSearch search = find_contact_points(
      mapped, separation, reach_skins * input.skin, list.contact_points());
  list.events.n_lost = search.n_lost;
  // The contact points are complete until the next one comes within the skin.
  const auto beyond = std::ranges::find_if(
      search.contact_points, [&](const ContactPoint &contact_point)
      { return contact_point.overlap <= -input.skin; });
  list.clear = beyond == search.contact_points.end() ? reach_skins * input.skin
                                                     : -beyond->overlap;
  search.contact_points.erase(beyond, search.contact_points.end());
  list.add(search.contact_points, input.is_first);
  return list;
}

/// How far the particles of a pair have come, and the images of a cell [m].
auto path_lengths(const ParticleSystem &particles, const PathLengths &paths)
{
  return [&particles, &paths](const PairKey &key)
  {
    return particles.path_length[row_of(key.first)] +
           particles.path_length[row_of(key.second)] + paths.cell;
  };
}

/// Where the pairs of these contacts are in the list.
std::vector<std::size_t> pairs_of(const ContactBatch &batch,
                                  const std::vector<std::int32_t> &contacts,
                                  const std::vector<CandidatePair> &pairs)
{
  std::vector<std::size_t> numbers;
  for (const std::int32_t k : contacts)
  {
    const PairKey key{batch.a[row_of(k)], batch.b[row_of(k)]};
    const auto found =
        std::ranges::lower_bound(pairs, key, {}, &CandidatePair::key);
    const auto number = static_cast<std::size_t>(found - pairs.begin());
    if (numbers.empty() || numbers.back() != number)
      numbers.push_back(number);
  }
  return numbers;
}

bool by_key(const CandidatePair &one, const CandidatePair &other)
{
  return one.key < other.key;
}
} // namespace

bool have_displaced(const ContactBatch &batch)
{
  for (std::size_t k = 0; k < batch.displaced.size(); ++k)
    if (has_displaced(batch, k))
      return true;
  return false;
}

ContactPointEvents &
ContactPointEvents::operator+=(const ContactPointEvents &part)
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

void ContactPointLists::renew_pairs(const ContactPointSearchInput &input,
                                    const PathLengths &paths,
                                    ContactBatch &batch, LostEnergy &retired)
{
  const ParticleSystem &particles = input.context.particles;
  if (needs_search(input.skin, paths))
    search(particles, input.skin, paths);
  events += renew(
      input, CandidateList{pairs, path_lengths(particles, paths), itself},
      [&](const CandidatePair &pair, const OldRows &old)
      { return list_pair(input, pair, batch, old); },
      batch, retired, [](const Arrangement &) {});
}

bool ContactPointLists::renew_displaced(const ContactPointSearchInput &input,
                                        const PathLengths &paths,
                                        ContactBatch &batch,
                                        LostEnergy &retired)
{
  const std::vector<std::int32_t> contacts = of_displaced_pairs(batch);
  const std::vector<std::size_t> numbers = pairs_of(batch, contacts, pairs);
  std::vector<CandidatePair> displaced;
  for (const std::size_t number : numbers)
    displaced.push_back(pairs[number]);
  Renewal made = renew_lists(
      displaced, OldList(batch, itself, contacts),
      [](const CandidatePair &, const OldRows &) { return true; },
      [&](const CandidatePair &pair, const OldRows &old)
      { return list_pair(input, pair, batch, old); });
  events += note_lists(input, made,
                       path_lengths(input.context.particles, paths), displaced);
  for (std::size_t d = 0; d < numbers.size(); ++d)
    pairs[numbers[d]] = displaced[d];
  // Whether there is room must not show in what comes: ranks may differ in it.
  for (const std::int32_t k : contacts)
  {
    batch.displaced[row_of(k)] = 0;
    batch.reactivation[row_of(k)] = 0.;
  }
  const LocalChanges changes(displaced, made, batch);
  if (changes.has_room())
  {
    carry_out(input, changes, batch, retired);
    return true;
  }
  const std::vector<std::int32_t> all = batch.by_pair();
  made.old = old_rows(pairs, OldList(batch, itself, all));
  made.due = numbers;
  arrange_anew(input, pairs, made, batch, retired);
  return false;
}

double ContactPointLists::search_range(const ParticleSystem &particles,
                                       double skin)
{
  return std::max(skin, std::min(3. * skin, widest_range(particles)));
}

void ContactPointLists::search(const ParticleSystem &particles, double skin,
                               const PathLengths &paths)
{
  const double range = search_range(particles, skin);
  pairs = merged(near_spheres(particles, range), pairs);
  reach = paths.centres + range;
}

std::vector<std::uint8_t>
ContactPointLists::named(std::size_t n_particles) const
{
  std::vector<std::uint8_t> is_named(n_particles, 0);
  for (const CandidatePair &pair : pairs)
    is_named[row_of(pair.key.first)] = is_named[row_of(pair.key.second)] = 1;
  return is_named;
}

void renumber_candidates(const std::vector<std::int32_t> &new_row,
                         std::vector<CandidatePair> &walls)
{
  for (CandidatePair &pair : walls)
    pair.key.first = new_row[row_of(pair.key.first)];
  std::sort(walls.begin(), walls.end(), by_key);
}

void ContactPointLists::renumber(const std::vector<std::int32_t> &new_row)
{
  for (CandidatePair &pair : pairs)
  {
    pair.key.first = new_row[row_of(pair.key.first)];
    pair.key.second = new_row[row_of(pair.key.second)];
  }
  std::sort(pairs.begin(), pairs.end(), by_key);
}
} // namespace dem
