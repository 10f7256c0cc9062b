#include "place_lists.h"

#include <dem/boundary/drum_contacts.h>

#include <limits>

namespace dem
{
namespace
{
PosedStone posed(const SpotSearchInput &input, std::size_t i)
{
  const Particles &particles = input.context.particles;
  return {input.maps.stone(particles, i), particles.position(i),
          particles.rotation(i)};
}

std::vector<WallPlace> places_of(const PairList &list)
{
  std::vector<WallPlace> places;
  for (const Row &row : list.rows)
  {
    WallPlace place;
    place.on_stone = row.spot.on_a;
    place.normal = row.foot.normal;
    places.push_back(place);
  }
  return places;
}

void add(const WallSearchResult &found, const SpotSearchInput &input,
         PairList &list)
{
  list.events.n_lost += found.n_lost;
  for (const WallPlace &place : found.places)
  {
    if (list.rows.size() >= most_wall_places)
    {
      ++list.events.n_unlisted;
      continue;
    }
    list.events.n_late += place.overlap > 0. && !input.is_first;
    list.rows.push_back({-1,
                         {place.on_stone, Vec3::UnitZ(), place.overlap, true},
                         {place.triangle, place.weight, place.normal}});
  }
}

/// One stone on one wall while its list is made.
struct StoneOnWall
{
  const SpotSearchInput &input;
  const ContactBatch &batch;
  OldRows old;
  double gap = 0.; ///< of its circumscribed sphere [m]
};

/// `foot(k)`: where contact k was; `climb(stone, start)`: to its place now;
/// `search(stone, known)`: all others.
template <class Foot, class Climb, class Search>
PairList list_on_wall(const StoneOnWall &on, std::size_t i, const Foot &foot,
                      const Climb &climb, const Search &search)
{
  PairList list;
  list.clear = std::max(on.input.margin, on.gap);
  list.events.n_scans = 1;
  const PosedStone stone = posed(on.input, i);
  StoneView view(stone.stone.body, stone.position, stone.rotation, 0.);
  for (const std::size_t k : alive_first(on.batch, on.old))
  {
    const Row row{static_cast<std::int32_t>(k),
                  {on.batch.side_a.spot(k), Vec3::UnitZ(), 0., true},
                  foot(k)};
    WallPlace start;
    start.on_stone = row.spot.on_a;
    start.triangle = row.foot.triangle;
    start.weight = row.foot.weight;
    const auto is_near = [&]
    {
      const WallPlace now = climb(view, start);
      return now.is_found && now.overlap > -on.input.margin;
    };
    if (on.batch.is_touching(k) || is_near())
      list.keep(row);
  }
  if (on.gap < on.input.margin)
    add(search(stone, places_of(list)), on.input, list);
  return list;
}

PairList list_smooth(const StoneOnWall &on, const PairKey &key,
                     const WatchedDrum &drum)
{
  const auto part = static_cast<DrumPart>(key.second);
  return list_on_wall(
      on, row_of(key.first),
      [&](std::size_t k) {
        return FacetSpot{-1, {}, drum.rows[row_of(on.batch.b[k])].normal};
      },
      [&](StoneView &stone, const WallPlace &start)
      { return climb_drum(stone, drum.drum, part, start); },
      [&](const PosedStone &stone, const std::vector<WallPlace> &known)
      { return find_on_drum(stone, drum.drum, part, on.input.margin, known); });
}

PairList list_shelf(const StoneOnWall &on, const PairKey &key,
                    const WatchedDrum &drum)
{
  const DrumShelf &shelf = drum.shelf;
  return list_on_wall(
      on, row_of(key.first),
      [&](std::size_t k)
      {
        const WallRow &row = drum.rows[row_of(on.batch.b[k])];
        const NearestPoint at = shelf.nearest(row.point);
        return FacetSpot{at.triangle, at.weight, row.normal};
      },
      [&](StoneView &stone, const WallPlace &start)
      { return climb_facets(stone, shelf.mesh(), start); },
      [&](const PosedStone &stone, const std::vector<WallPlace> &known)
      {
        return find_on_facets(stone, shelf.mesh(), shelf.all(), on.input.margin,
                              known);
      });
}

PairList list_facets(const StoneOnWall &on, const PairKey &key,
                     const WatchedFacets &facets)
{
  return list_on_wall(
      on, row_of(key.first),
      [&](std::size_t k) { return facets.candidates.spot[k]; },
      [&](StoneView &stone, const WallPlace &start)
      { return climb_facets(stone, facets.mesh, start); },
      [&](const PosedStone &stone, const std::vector<WallPlace> &known)
      {
        return find_on_facets(
            stone, facets.mesh,
            facets.candidates.triangles_of(facets.row_of_stone(key.first)),
            on.input.margin, known);
      });
}

/// Overlaps with a wall that was not there before count in full.
SpotSearchInput first_look(SpotSearchInput input,
                           const std::vector<WatchedPair> &known)
{
  input.is_first = input.is_first || known.empty();
  return input;
}

/// Gap between the circumscribed sphere of a stone and its triangles [m].
double sphere_gap(const Particles &particles, const WatchedFacets &facets,
                  std::int32_t stone)
{
  const Vec3 &x = particles.position(row_of(stone));
  double least = std::numeric_limits<double>::infinity();
  for (const std::int32_t t :
       facets.candidates.triangles_of(facets.row_of_stone(stone)))
    least = std::min(
        least, (nearest_point(x, corners_of(facets.mesh.surface, t)).point - x)
                   .norm());
  return least - particles.body[row_of(stone)].circumscribed_radius;
}

/// The rows of a drum go with their contacts, which take new numbers.
void number_drum(const Arrangement &to, const WatchedDrum &drum,
                 ContactBatch &batch)
{
  std::vector<WallRow> rows(to.source.size() * row_of(n_drum_parts));
  for (std::size_t k = 0; k < to.source.size(); ++k)
  {
    const std::int32_t part = to.key[k].second;
    batch.b[k] = n_drum_parts * static_cast<std::int32_t>(k) + part;
    WallRow &row = rows[row_of(batch.b[k])];
    const FacetSpot &foot = to.row[k]->foot;
    if (to.source[k] >= 0)
      row = drum.rows[row_of(n_drum_parts * to.source[k] + part)];
    else
      row.normal = row.normal_before = foot.normal;
    if (to.source[k] < 0 && foot.triangle >= 0)
      row.point = point_at(drum.shelf.mesh().surface, foot);
  }
  drum.rows = std::move(rows);
}
} // namespace

std::size_t WatchedFacets::row_of_stone(std::int32_t stone) const
{
  const auto at =
      std::lower_bound(candidates.stone.begin(), candidates.stone.end(), stone);
  return static_cast<std::size_t>(at - candidates.stone.begin());
}

void SpotLists::renew_drum(const SpotSearchInput &asked,
                           const WatchedDrum &drum, ContactBatch &batch,
                           Dissipation &retired)
{
  const Particles &particles = asked.context.particles;
  const auto gap = [&](const PairKey &key)
  {
    return nearest_on_drum(drum.drum, static_cast<DrumPart>(key.second),
                           particles.position(row_of(key.first)))
               .distance -
           particles.body[row_of(key.first)].circumscribed_radius;
  };
  std::vector<PairKey> keys;
  for (std::int32_t i = 0; row_of(i) < particles.size(); ++i)
    for (std::int32_t part = 0; part < n_drum_parts; ++part)
      if (gap({i, part}) < far_margins * asked.margin)
        keys.emplace_back(i, part);
  const SpotSearchInput input = first_look(asked, on_drum);
  on_drum = merged(keys, on_drum);
  const auto travelled = [&](const PairKey &key)
  { return particles.travelled[row_of(key.first)] + drum.travelled; };
  events += renew(
      input,
      Watch{on_drum, travelled,
            [](std::int32_t b) { return b % n_drum_parts; }},
      [&](const WatchedPair &pair, const OldRows &old)
      {
        const StoneOnWall on{input, batch, old, gap(pair.key)};
        return pair.key.second == static_cast<std::int32_t>(DrumPart::shelf)
                   ? list_shelf(on, pair.key, drum)
                   : list_smooth(on, pair.key, drum);
      },
      batch, retired,
      [&](const Arrangement &to) { number_drum(to, drum, batch); });
}

void SpotLists::renew_facets(const SpotSearchInput &asked,
                             const WatchedFacets &facets, ContactBatch &batch,
                             Dissipation &retired)
{
  const Particles &particles = asked.context.particles;
  std::vector<PairKey> keys;
  for (const std::int32_t stone : facets.candidates.stone)
    keys.emplace_back(stone, 0);
  const SpotSearchInput input = first_look(asked, facets.stones);
  facets.stones = merged(keys, facets.stones);
  const FacetSurface &surface = facets.mesh.surface;
  // Since its last search: a list is good for so much of it.
  const auto moved = [&](const PairKey &key)
  {
    return facets.watch.moved(particles, surface, key.first,
                              facets.row_of_stone(key.first));
  };
  events += renew(
      input,
      Watch{facets.stones, moved, [](std::int32_t) { return std::int32_t{0}; }},
      [&](const WatchedPair &pair, const OldRows &old)
      {
        facets.watch.note(particles, surface, pair.key.first,
                          facets.row_of_stone(pair.key.first));
        const double gap = sphere_gap(particles, facets, pair.key.first);
        return list_facets({input, batch, old, gap}, pair.key, facets);
      },
      batch, retired,
      [&](const Arrangement &to)
      {
        std::vector<FacetSpot> spots;
        for (std::size_t k = 0; k < to.source.size(); ++k)
        {
          spots.push_back(to.source[k] >= 0
                              ? facets.candidates.spot[row_of(to.source[k])]
                              : to.row[k]->foot);
          batch.b[k] = static_cast<std::int32_t>(k);
        }
        facets.candidates.spot = std::move(spots);
        facets.candidates.wake.assign(batch.size(), 0.);
      });
}
} // namespace dem
