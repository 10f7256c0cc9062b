// The boundaries of the engine: their lists, where particles meet them, their
// loads and work.
#include <dem/engine.h>

#include <algorithm>
#include <utility>

namespace dem
{
namespace
{
/// Triangles are gathered that far beyond the bound of a particle that they
/// serve its search for some while [bounds].
constexpr double facet_gathering = 1.25;

/// Margin of searches on facets over the radius of the smallest particle.
constexpr double facet_margin = 0.04;
/// Part of it that may be used up until the next look: looks cost little,
/// searches much.
constexpr double facet_notice = 0.5;
} // namespace

bool Engine::follows_walls() const
{
  return system.has_shapes &&
         settings.geometry.wall_geometry == ContactGeometry::surface;
}

void Engine::rebuild_plane_list()
{
  const BatchLayout layout = wall_layout(settings, settings.wall, system);
  if (layout.has_contact_points)
  {
    const ForceContext still = context(0.);
    contact_points.renew_planes(contact_point_search(still, layout), walls,
                                walls_travelled, plane_batch, lost);
    return;
  }
  rebuild_planes(system, walls,
                 {layout, settings.geometry.wall_geometry, margin.width},
                 plane_batch, lost);
}

void Engine::rebuild_drum_list()
{
  const BatchLayout layout = wall_layout(settings, settings.wall, system);
  if (!follows_walls())
  {
    rebuild_drum(system, barrel,
                 {layout, settings.geometry.wall_geometry, margin.width},
                 drum_batch, lost);
    return;
  }
  lifter.turn(barrel);
  const ForceContext still = context(0.);
  contact_points.renew_drum(contact_point_search(still, layout),
                            {barrel, lifter, walls_travelled, drum_walls},
                            drum_batch, lost);
}

void Engine::gather_facets(const WallSearch &search, SurfaceContacts &facets)
{
  FacetCandidates near = near_facets(system, facets.surface, search);
  near.contact_point = std::move(facets.candidates.contact_point);
  near.reactivation = std::move(facets.candidates.reactivation);
  facets.candidates = std::move(near);
  facets.watch.start(system, facets.surface, facets.candidates, search);
}

void Engine::rebuild_facet_list(SurfaceContacts &facets)
{
  WallSearch search{wall_layout(settings, facets.material, system),
                    settings.geometry.wall_geometry, margin.width};
  if (!follows_walls())
  {
    rebuild_facets(system, facets.surface, search, facets.candidates,
                   facets.batch, lost);
    return;
  }
  const ForceContext still = context(0.);
  ContactPointSearchInput input = contact_point_search(still, search.layout);
  input.margin = facet_margin * system.smallest_radius();
  if (facets_left < 0.)
    facets_left = facet_notice * input.margin;
  input.notice = facets_left;
  search.margin = input.margin;
  search.reach = facet_gathering;
  if (!facets.watch.covers(system, facets.surface, input.margin))
    gather_facets(search, facets);
  contact_points.renew_facets(
      input,
      {facets.mesh(), facets.candidates, facets.near_particles, facets.watch},
      facets.batch, lost);
}

PlacedDrum Engine::placed_drum()
{
  return {barrel, lifter, drum_walls, drum_overlap};
}

PlacedFacets Engine::placed_facets(SurfaceContacts &facets)
{
  return {facets.mesh(), facets.candidates, sheets_travelled, facets.rows,
          facets.overlap};
}

void Engine::meet_walls(double time_step)
{
  plane_rows(walls, plane_walls);
  const ForceContext moved = context(time_step);
  if (barrel.is_there() && !follows_walls())
    find_drum(system, barrel, drum_batch, drum_walls);
  else if (barrel.is_there())
  {
    lifter.turn(barrel);
    count_places(place_on_drum(moved, placed_drum(), drum_batch));
  }
  for (SurfaceContacts &facets : facet_surfaces)
    if (follows_walls())
    {
      ForceSum sum =
          place_on_facets(moved, placed_facets(facets), facets.batch);
      facets_are_stale |= std::exchange(sum.has_displaced, false);
      count_places(sum);
    }
    else
      find_facets(moved, facets.mesh(), facets.batch, facets.candidates,
                  facets.rows, facets.extra);
}

Walls Engine::walls_of_planes()
{
  return {settings.wall, plane_walls};
}

Walls Engine::walls_of_drum()
{
  if (!follows_walls())
    return {settings.wall, drum_walls};
  return {settings.wall, drum_walls, drum_overlap, {}, [this](std::size_t k) {
            place_again(context(0.), placed_drum(), drum_batch, k);
          }};
}

Walls Engine::walls_of_facets(SurfaceContacts &facets)
{
  if (!follows_walls())
    return {facets.material, facets.rows, {}, facets.extra, {}};
  return {facets.material,
          facets.rows,
          facets.overlap,
          {},
          [this, &facets](std::size_t k) {
            place_again(context(0.), placed_facets(facets), facets.batch, k);
          }};
}

void Engine::move_planes(double time_step)
{
  for (Plane &plane : walls)
  {
    plane.point += time_step * plane.velocity;
    // Trapezoidal rule: this half with the old force, load_planes the other.
    plane.work -= 0.5 * time_step * plane.force.dot(plane.velocity);
    plane.impulse += 0.5 * time_step * plane.force;
  }
  barrel.angle += time_step * barrel.spin;
  barrel.radius += time_step * barrel.widening;
  book_drum(time_step);
}

void Engine::load_boundaries(double time_step)
{
  load_planes(time_step);
  load_drum(time_step);
  for (SurfaceContacts &facets : facet_surfaces)
    facets.book_step(time_step);
}

void Engine::load_planes(double time_step)
{
  for (Plane &plane : walls)
    plane.force = Vec3::Zero();
  for (std::size_t k = 0; k < plane_batch.size(); ++k)
    walls[static_cast<std::size_t>(plane_batch.b[k])].force -=
        plane_batch.load[k].force;
  for (Plane &plane : walls)
  {
    plane.work -= 0.5 * time_step * plane.force.dot(plane.velocity);
    plane.impulse += 0.5 * time_step * plane.force;
  }
}

void Engine::load_drum(double time_step)
{
  if (!barrel.is_there())
    return;
  barrel.torque = drum_torque(barrel, drum_batch, drum_walls);
  barrel.thrust = drum_thrust(drum_batch, drum_walls);
  book_drum(time_step);
}

/// Half a step with the forces as they are.
void Engine::book_drum(double time_step)
{
  barrel.work -=
      0.5 * time_step *
      (barrel.torque * barrel.spin + barrel.thrust * barrel.widening);
}
} // namespace dem
