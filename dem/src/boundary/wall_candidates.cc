#include "../contact/surfaces.h"
#include "../neighbor/carry_over.h"
#include "triangle_bins.h"

#include <dem/boundary/drum_contacts.h>
#include <dem/boundary/wall_candidates.h>
#include <dem/boundary/wall_list.h>

#include <algorithm>
#include <utility>

namespace dem
{
namespace
{
std::vector<PairKey> keys_of(const ContactBatch &batch)
{
  std::vector<PairKey> keys(batch.size());
  for (std::size_t k = 0; k < batch.size(); ++k)
    keys[k] = {batch.a[k], batch.b[k]};
  return keys;
}

/// Slots of the particles that stay near go with them, the others retire.
void carry_over_slots(const ParticleSystem &particles,
                      const FacetCandidates &before, const BatchLayout &layout,
                      const FacetCandidates &after,
                      std::vector<FacetContactPoint> &contact_points,
                      ContactBatch &batch, LostEnergy &retired)
{
  const bool is_damage_new = layout.has_damage && !batch.layout.has_damage;
  constexpr auto n_slots = static_cast<std::size_t>(slots_per_particle);
  const auto keys = [](const FacetCandidates &candidates)
  {
    std::vector<PairKey> of_slots;
    for (const std::int32_t particle : candidates.particle)
      for (std::int32_t s = 0; s < slots_per_particle; ++s)
        of_slots.emplace_back(particle, s);
    return of_slots;
  };
  const std::vector<std::int32_t> source =
      match(keys(before), keys(after),
            [&](std::size_t k) { retire_contact(batch, k, retired); });
  batch.rearrange(layout, source);
  const auto points_before = std::exchange(
      contact_points, std::vector<FacetContactPoint>(source.size()));
  for (std::size_t k = 0; k < source.size(); ++k)
  {
    if (source[k] >= 0)
      contact_points[k] = points_before[static_cast<std::size_t>(source[k])];
    batch.a[k] = after.particle[k / n_slots];
    batch.b[k] = static_cast<std::int32_t>(k);
  }
  if (is_damage_new)
    note_corners(particles, batch);
}
} // namespace

std::vector<std::int32_t> rebuild_walls(const ParticleSystem &particles,
                                        const std::vector<PairKey> &keys,
                                        const BatchLayout &layout,
                                        ContactBatch &batch,
                                        LostEnergy &retired)
{
  const bool is_damage_new = layout.has_damage && !batch.layout.has_damage;
  std::vector<std::int32_t> source =
      match(keys_of(batch), keys,
            [&](std::size_t k) { retire_contact(batch, k, retired); });
  batch.rearrange(layout, source);
  for (std::size_t k = 0; k < keys.size(); ++k)
  {
    batch.a[k] = keys[k].first;
    batch.b[k] = keys[k].second;
  }
  if (is_damage_new)
    note_corners(particles, batch);
  return source;
}

void rebuild_planes(const ParticleSystem &particles,
                    const std::vector<Plane> &planes, const WallSearch &search,
                    ContactBatch &batch, LostEnergy &retired)
{
  std::vector<PairKey> keys;
  for (std::size_t i = 0; i < particles.n_owned(); ++i)
    for (std::size_t p = 0; p < planes.size(); ++p)
      if (planes[p].is_active &&
          (particles.position(i) - planes[p].point).dot(planes[p].normal) <
              wall_bound(particles, i, search.geometry) + search.skin)
        keys.emplace_back(static_cast<std::int32_t>(i),
                          static_cast<std::int32_t>(p));
  rebuild_walls(particles, keys, search.layout, batch, retired);
}

void rebuild_drum(const ParticleSystem &particles, const Drum &drum,
                  const WallSearch &search, ContactBatch &batch,
                  std::vector<WallRow> &rows, LostEnergy &retired)
{
  std::vector<PairKey> keys;
  for (std::size_t i = 0; i < particles.n_owned(); ++i)
    for (std::int32_t part = 0; part < n_drum_parts; ++part)
      if (nearest_on_drum(drum, static_cast<DrumPart>(part),
                          particles.position(i))
              .distance <
          wall_bound(particles, i, search.geometry) + search.skin)
        keys.emplace_back(static_cast<std::int32_t>(i), part);
  name_by_part(batch);
  number_drum_contacts(
      rebuild_walls(particles, keys, search.layout, batch, retired), batch,
      rows);
}

double facet_reach(const ParticleSystem &particles, std::size_t particle,
                   const WallSearch &search)
{
  return search.reach * wall_bound(particles, particle, search.geometry) +
         search.skin;
}

FacetCandidates near_facets(const ParticleSystem &particles,
                            const FacetSurface &surface,
                            const WallSearch &search)
{
  const TriangleBins bins(surface);
  FacetCandidates fresh;
  std::vector<std::int32_t> found;
  for (std::size_t i = 0; i < particles.n_owned(); ++i)
  {
    const Vec3 &x = particles.position(i);
    const double reach = facet_reach(particles, i, search);
    bins.gather(x, reach, found);
    const std::size_t before = fresh.triangle.size();
    for (const std::int32_t t : found)
    {
      const auto &corner = surface.triangles[static_cast<std::size_t>(t)];
      const NearestPoint nearest = nearest_point(
          x, {surface.position[static_cast<std::size_t>(corner[0])],
              surface.position[static_cast<std::size_t>(corner[1])],
              surface.position[static_cast<std::size_t>(corner[2])]});
      if ((nearest.point - x).squaredNorm() < reach * reach)
        fresh.triangle.push_back(t);
    }
    if (fresh.triangle.size() == before)
      continue;
    fresh.particle.push_back(static_cast<std::int32_t>(i));
    fresh.row_start.push_back(static_cast<std::int32_t>(fresh.triangle.size()));
  }
  return fresh;
}

void rebuild_facets(const ParticleSystem &particles,
                    const FacetSurface &surface, const WallSearch &search,
                    FacetCandidates &candidates,
                    std::vector<FacetContactPoint> &contact_points,
                    ContactBatch &batch, LostEnergy &retired)
{
  FacetCandidates fresh = near_facets(particles, surface, search);
  fresh.reactivation.assign(fresh.particle.size(), 0.);
  fresh.triangle_reactivation.assign(fresh.triangle.size(), 0.);
  carry_over_slots(particles, candidates, search.layout, fresh, contact_points,
                   batch, retired);
  candidates = std::move(fresh);
}
} // namespace dem
