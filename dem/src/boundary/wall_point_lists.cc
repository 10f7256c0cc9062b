#include "../neighbor/point_list_renewal.h"

#include <dem/boundary/drum_contacts.h>
#include <dem/boundary/wall_contact_points.h>
#include <dem/boundary/wall_point_lists.h>

#include <limits>
#include <utility>

namespace dem
{
namespace
{
MappedParticlePose posed(const ContactPointSearchInput &input, std::size_t i)
{
  const ParticleSystem &particles = input.context.particles;
  return {input.maps.particle(particles, i), particles.position(i),
          particles.rotation(i)};
}

/// A contact point on a wall in the form that the lists keep.
WallContactPoint foot_at(const FacetContactPoint &at)
{
  WallContactPoint foot;
  foot.triangle = static_cast<std::int32_t>(at.triangle);
  foot.weight = at.weight;
  foot.normal = at.normal;
  return foot;
}

FacetContactPoint on_facets(const WallContactPoint &foot)
{
  return {foot.triangle, foot.weight, foot.normal, {}};
}

std::vector<WallContactPoint> contact_points_of(const PairList &list)
{
  std::vector<WallContactPoint> contact_points;
  for (const Row &row : list.rows)
  {
    WallContactPoint contact_point;
    contact_point.on_particle = row.contact_point.on_a;
    contact_point.normal = row.foot.normal;
    contact_points.push_back(contact_point);
  }
  return contact_points;
}

void add(const WallSearchResult &found, const ContactPointSearchInput &input,
         PairList &list)
{
  list.events.n_lost += found.n_lost;
  for (const WallContactPoint &contact_point : found.contact_points)
  {
    if (list.rows.size() >= most_wall_contact_points)
    {
      ++list.events.n_unlisted;
      continue;
    }
    list.events.n_late += contact_point.overlap > 0. && !input.is_first;
    list.rows.push_back({-1,
                         {contact_point.on_particle, Vec3::UnitZ(),
                          contact_point.overlap, true},
                         contact_point});
  }
}

/// One particle on one wall while its list is made.
struct ParticleOnWall
{
  const ContactPointSearchInput &input;
  const ContactBatch &batch;
  OldRows old;
  double gap = 0.; ///< of its circumscribed sphere [m]
};

/// `foot(k)`: where contact k was; `refine(particle, start)`: to its contact
/// point now; `search(particle, known)`: all others.
template <class Foot, class Refine, class Search>
PairList list_on_wall(const ParticleOnWall &on, std::size_t i, const Foot &foot,
                      const Refine &refine, const Search &search)
{
  PairList list;
  list.clear = std::max(on.input.skin, on.gap);
  list.events.n_scans = 1;
  const MappedParticlePose particle = posed(on.input, i);
  ParticleView view(particle.particle.body, particle.position,
                    particle.rotation, 0.);
  for (const std::size_t k : alive_first(on.batch, on.old))
  {
    Row row{static_cast<std::int32_t>(k),
            {on.batch.side_a.contact_point(k), Vec3::UnitZ(), 0., true},
            foot_at(foot(k))};
    row.foot.on_particle = row.contact_point.on_a;
    WallContactPoint start;
    start.on_particle = row.contact_point.on_a;
    start.triangle = row.foot.triangle;
    start.weight = row.foot.weight;
    const auto is_near = [&]
    {
      const WallContactPoint now = refine(view, start);
      return now.is_found && now.overlap > -on.input.skin;
    };
    if (!on.batch.is_touching(k) && !is_near())
      continue;
    if (row.foot.triangle < 0)
      list.keep(row);
    else
      list.keep(row, [](const Row &one, const Row &other)
                { return is_one_contact_point(one.foot, other.foot); });
  }
  if (on.gap < on.input.skin)
    add(search(particle, contact_points_of(list)), on.input, list);
  return list;
}

PairList list_smooth(const ParticleOnWall &on, const PairKey &key,
                     const DrumCandidates &drum)
{
  const auto part = static_cast<DrumPart>(key.second);
  return list_on_wall(
      on, row_of(key.first),
      [&](std::size_t k) {
        return FacetContactPoint{
            -1, {}, drum.rows[row_of(on.batch.b[k])].normal};
      },
      [&](ParticleView &particle, const WallContactPoint &start)
      { return refine_on_drum(particle, drum.drum, part, start); },
      [&](const MappedParticlePose &particle,
          const std::vector<WallContactPoint> &known) {
        return find_on_drum(particle, drum.drum, part, on.input.skin, known);
      });
}

PairList list_lifter(const ParticleOnWall &on, const PairKey &key,
                     const DrumCandidates &drum)
{
  const DrumLifter &lifter = drum.lifter;
  return list_on_wall(
      on, row_of(key.first),
      [&](std::size_t k)
      {
        const WallRow &row = drum.rows[row_of(on.batch.b[k])];
        const NearestPoint at = lifter.nearest(row.point);
        return FacetContactPoint{at.triangle, at.weight, row.normal};
      },
      [&](ParticleView &particle, const WallContactPoint &start)
      { return refine_on_facets(particle, lifter.mesh(), start); },
      [&](const MappedParticlePose &particle,
          const std::vector<WallContactPoint> &known)
      {
        return find_on_facets(particle, lifter.mesh(), lifter.all(),
                              on.input.skin, known);
      });
}

PairList list_facets(const ParticleOnWall &on, const PairKey &key,
                     const FacetCandidateRows &facets)
{
  return list_on_wall(
      on, row_of(key.first),
      [&](std::size_t k) { return facets.contact_points.point[k]; },
      [&](ParticleView &particle, const WallContactPoint &start)
      { return refine_on_facets(particle, facets.mesh, start); },
      [&](const MappedParticlePose &particle,
          const std::vector<WallContactPoint> &known)
      {
        return find_on_facets(
            particle, facets.mesh,
            facets.candidates.triangles_of(facets.row_of_particle(key.first)),
            on.input.skin, known);
      });
}

/// Gap between the circumscribed sphere of a particle and its triangles [m].
double sphere_gap(const ParticleSystem &particles,
                  const FacetCandidateRows &facets, std::int32_t particle)
{
  const Vec3 &x = particles.position(row_of(particle));
  double least = std::numeric_limits<double>::infinity();
  for (const std::int32_t t :
       facets.candidates.triangles_of(facets.row_of_particle(particle)))
    least = std::min(
        least, (nearest_point(x, corners_of(facets.mesh.surface, t)).point - x)
                   .norm());
  return least - particles.shape[row_of(particle)].circumscribed_radius;
}

/// The rows of a drum go with their contacts, which take new numbers.
void number_drum(const Arrangement &to, const DrumCandidates &drum,
                 ContactBatch &batch)
{
  std::vector<WallRow> rows(to.source.size() * row_of(n_drum_parts));
  for (std::size_t k = 0; k < to.source.size(); ++k)
  {
    const std::int32_t part = to.key[k].second;
    batch.b[k] = n_drum_parts * static_cast<std::int32_t>(k) + part;
    WallRow &row = rows[row_of(batch.b[k])];
    const FacetContactPoint foot = on_facets(to.row[k]->foot);
    if (to.source[k] >= 0)
      row = drum.rows[row_of(n_drum_parts * to.source[k] + part)];
    else
      row.normal = row.normal_before = foot.normal;
    if (to.source[k] < 0 && foot.triangle >= 0)
      row.point = point_at(drum.lifter.mesh().surface, foot);
  }
  drum.rows = std::move(rows);
}
PairList list_support(const ContactPointSearchInput &input, const PairKey &key,
                      const Plane &plane, const ContactBatch &batch,
                      const OldRows &old)
{
  const ParticleSystem &particles = input.context.particles;
  const std::size_t i = row_of(key.first);
  const Vec3 normal = particles.orientation(i).conjugate() * -plane.normal;
  const double distance =
      (particles.position(i) - plane.point).dot(plane.normal);
  PairList list;
  list.clear =
      std::max(input.skin, distance - particles.shape[i].circumscribed_radius);
  list.events.n_scans = 1;
  for (const std::size_t k : alive_first(batch, old))
  {
    ContactPoint contact_point{batch.side_a.contact_point(k), Vec3::UnitZ(), 0.,
                               true};
    contact_point.overlap =
        batch.is_touching(k)
            ? batch.overlap[k]
            : surface_point(particles.shape[i], contact_point.on_a)
                      .position.dot(normal) -
                  distance;
    if (contact_point.overlap > -input.skin)
      list.keep({static_cast<std::int32_t>(k), contact_point, {}});
  }
  if (list.clear == input.skin)
    list.add(find_supports(input.maps.particle(particles, i), normal,
                           {distance - input.skin, distance},
                           list.contact_points()),
             input.is_first);
  return list;
}

} // namespace

std::size_t FacetCandidateRows::row_of_particle(std::int32_t particle) const
{
  const auto at = std::lower_bound(candidates.particle.begin(),
                                   candidates.particle.end(), particle);
  return static_cast<std::size_t>(at - candidates.particle.begin());
}

ContactPointEvents renew_planes(const ContactPointSearchInput &input,
                                const PlaneCandidates &walls,
                                std::vector<CandidatePair> &listed,
                                ContactBatch &batch, LostEnergy &retired)
{
  const ParticleSystem &particles = input.context.particles;
  const std::vector<Plane> &planes = walls.planes;
  std::vector<PairKey> keys;
  for (std::size_t i = 0; i < particles.n_owned(); ++i)
    for (std::size_t p = 0; p < planes.size(); ++p)
      if (planes[p].is_active &&
          (particles.position(i) - planes[p].point).dot(planes[p].normal) <
              particles.shape[i].circumscribed_radius + far_skins * input.skin)
        keys.emplace_back(static_cast<std::int32_t>(i),
                          static_cast<std::int32_t>(p));
  listed = merged(keys, listed);
  const auto path_length = [&](const PairKey &key)
  { return particles.path_length[row_of(key.first)] + walls.path_length; };
  return renew(
      input, CandidateList{listed, path_length, itself},
      [&](const CandidatePair &pair, const OldRows &old)
      {
        return list_support(input, pair.key, planes[row_of(pair.key.second)],
                            batch, old);
      },
      batch, retired, [](const Arrangement &) {});
}

ContactPointEvents renew_drum(const ContactPointSearchInput &input,
                              const DrumCandidates &drum,
                              std::vector<CandidatePair> &listed,
                              ContactBatch &batch, LostEnergy &retired)
{
  const ParticleSystem &particles = input.context.particles;
  const auto gap = [&](const PairKey &key)
  {
    return nearest_on_drum(drum.drum, static_cast<DrumPart>(key.second),
                           particles.position(row_of(key.first)))
               .distance -
           particles.shape[row_of(key.first)].circumscribed_radius;
  };
  std::vector<PairKey> keys;
  for (std::int32_t i = 0; row_of(i) < particles.n_owned(); ++i)
    for (std::int32_t part = 0; part < n_drum_parts; ++part)
      if (gap({i, part}) < far_skins * input.skin)
        keys.emplace_back(i, part);
  listed = merged(keys, listed);
  const auto path_length = [&](const PairKey &key)
  { return particles.path_length[row_of(key.first)] + drum.path_length; };
  return renew(
      input,
      CandidateList{listed, path_length,
                    [](std::int32_t b) { return b % n_drum_parts; }},
      [&](const CandidatePair &pair, const OldRows &old)
      {
        const ParticleOnWall on{input, batch, old, gap(pair.key)};
        return pair.key.second == static_cast<std::int32_t>(DrumPart::lifter)
                   ? list_lifter(on, pair.key, drum)
                   : list_smooth(on, pair.key, drum);
      },
      batch, retired,
      [&](const Arrangement &to) { number_drum(to, drum, batch); });
}

ContactPointEvents renew_facets(const ContactPointSearchInput &input,
                                const FacetCandidateRows &facets,
                                ContactBatch &batch, LostEnergy &retired)
{
  const ParticleSystem &particles = input.context.particles;
  std::vector<PairKey> keys;
  for (const std::int32_t particle : facets.candidates.particle)
    keys.emplace_back(particle, 0);
  facets.particles = merged(keys, facets.particles);
  const FacetSurface &surface = facets.mesh.surface;
  // Since its last search: a list is good for so much of it.
  const auto moved = [&](const PairKey &key)
  {
    return facets.watch.moved(particles, surface, key.first,
                              facets.row_of_particle(key.first));
  };
  return renew(
      input,
      CandidateList{facets.particles, moved,
                    [](std::int32_t) { return std::int32_t{0}; }},
      [&](const CandidatePair &pair, const OldRows &old)
      {
        facets.watch.note(particles, surface, pair.key.first,
                          facets.row_of_particle(pair.key.first));
        const double gap = sphere_gap(particles, facets, pair.key.first);
        return list_facets({input, batch, old, gap}, pair.key, facets);
      },
      batch, retired,
      [&](const Arrangement &to)
      {
        // When known contacts are looked at again does not depend on others.
        const FacetContactPoints known =
            std::exchange(facets.contact_points, {});
        auto &[points, reactivation, ridge] = facets.contact_points;
        for (std::size_t k = 0; k < to.source.size(); ++k)
        {
          const std::int32_t from = to.source[k];
          points.push_back(from >= 0 ? known.point[row_of(from)]
                                     : on_facets(to.row[k]->foot));
          reactivation.push_back(from >= 0 ? known.reactivation[row_of(from)]
                                           : 0.);
          ridge.push_back(from >= 0 ? known.ridge[row_of(from)] : FacetRidge{});
          batch.b[k] = static_cast<std::int32_t>(k);
        }
      });
}
} // namespace dem
