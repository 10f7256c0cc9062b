#include "phase_timer.h"

#include <dem/engine.h>
#include <dem/integrate/verlet.h>
#include <dem/search/space_order.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <stdexcept>

// The lists of contacts: kept as long as no particle can have come to a new
// one.
namespace dem
{
namespace
{
std::int64_t count_touching(const ContactBatch &batch)
{
  std::int64_t n = 0;
  for (std::size_t k = 0; k < batch.size(); ++k)
    n += batch.is_touching(k);
  return n;
}

/// The fastest point of planes and drum towards a particle [m/s].
double fastest_wall(const std::vector<Plane> &planes, const Drum &drum)
{
  double square = 0.;
  for (const Plane &plane : planes)
    if (plane.is_active)
      square = std::max(square, plane.velocity.squaredNorm());
  // Of a drum that turns the lifter alone comes nearer to a particle.
  const double rim = drum.lifter_height > 0. ? drum.spin * drum.radius : 0.;
  return std::sqrt(std::max(square, rim * rim + drum.widening * drum.widening));
}

double fastest_vertex(const std::vector<SurfaceContacts> &surfaces) // [m/s]
{
  double square = 0., check = 0.; // a maximum passes over NaN, a sum does not
  for (const SurfaceContacts &facets : surfaces)
    for (const Vec3 &velocity : facets.surface.velocity)
    {
      square = std::max(square, velocity.squaredNorm());
      check += 0. * velocity.squaredNorm();
    }
  if (!std::isfinite(check))
    throw std::runtime_error("a vertex of a boundary surface has a velocity "
                             "that is no finite number: the step of the "
                             "boundary is too long");
  return std::sqrt(square);
}

/// From here on particles are put in order of place: neighbours lie near each
/// other in the caches, and few loads go to particles of other ranges of
/// contacts and other threads.
constexpr std::size_t sorted_from = 128;

/// Open pairs sleep, so they cost little.
constexpr SkinWidth::Cost list_of_spheres{8., 0.15},
    list_of_expansions{8., 0.3}, list_of_surfaces{50., 0.3};

const SkinWidth::Cost &cost_of_list(ContactGeometry geometry)
{
  switch (geometry)
  {
  case ContactGeometry::sphere:
    return list_of_spheres;
  case ContactGeometry::radial:
    return list_of_expansions;
  case ContactGeometry::surface:
    break;
  }
  return list_of_surfaces;
}

/// Throws std::runtime_error with the first particle whose position, velocity,
/// spin or orientation is no finite number, before a list or a grid turns it
/// into a place in memory.
[[noreturn]] void report_not_finite(const ParticleSystem &particles,
                                    double time)
{
  for (std::size_t i = 0; i < particles.size(); ++i)
  {
    const ParticleState &state = particles.state[i];
    const bool has_place = state.position.allFinite();
    if (has_place && state.velocity.allFinite() && state.spin.allFinite() &&
        particles.orientation(i).coeffs().allFinite())
      continue;
    char text[200];
    std::snprintf(text, sizeof text,
                  "particle %lld has %s that is no finite number at %.8g s: "
                  "the step is too long, or an input is no number",
                  static_cast<long long>(particles.id[i]),
                  has_place ? "a velocity or a spin" : "a position", time);
    throw std::runtime_error(text);
  }
  throw std::runtime_error("some particle moves by no finite number");
}

/// Throws std::runtime_error where particles leap, before they are lost to all
/// lists and their places to numbers.
void require_sane(double fastest, double time_step,
                  const ParticleSystem &system)
{
  constexpr double most = 100.; // radii in one step
  const double leap = fastest * time_step;
  // Nearly always any particle is large enough.
  if (leap == 0. || leap <= most * system.radius(0) ||
      leap <= most * system.largest_radius())
    return;
  char text[160];
  std::snprintf(text, sizeof text,
                "particles leap by %.3g m in a step of %.3g s, more than a "
                "hundred of their radii: the step is too long",
                leap, time_step);
  throw std::runtime_error(text);
}

/// How far the point is beyond the walls [m]; below 0: inside.
double beyond_walls(const std::vector<Plane> &planes, const Drum &drum,
                    const Vec3 &point)
{
  double most = -std::numeric_limits<double>::infinity();
  for (const Plane &plane : planes)
    if (plane.is_active)
      most = std::max(most, (plane.point - point).dot(plane.normal));
  if (drum.is_there())
    for (const DrumPart part :
         {DrumPart::cylinder, DrumPart::lower_end, DrumPart::upper_end})
      most = std::max(most, -nearest_on_drum(drum, part, point).distance);
  return most;
}

/// Throws std::runtime_error where all of a particle is beyond a wall: nothing
/// would bring it back.
void require_inside(const std::vector<Plane> &planes, const Drum &drum,
                    const ParticleSystem &system)
{
  for (std::size_t i = 0; i < system.size(); ++i)
  {
    const Vec3 &at = system.position(i);
    if (beyond_walls(planes, drum, at) <= system.shape[i].circumscribed_radius)
      continue;
    char text[224];
    std::snprintf(
        text, sizeof text,
        "particle %d of %.3g g has come through a wall at (%.4g, %.4g, "
        "%.4g) m: the step is too long, or the particle too soft for "
        "what presses it",
        static_cast<int>(system.id[i]), 1e3 * system.mass(i), at.x(), at.y(),
        at.z());
    throw std::runtime_error(text);
  }
}
} // namespace

void Engine::keep_lists(const Speeds &fastest, double time_step)
{
  if (!fastest.is_finite)
    report_not_finite(system, now);
  require_sane(fastest.moving, time_step, system);
  const double rigid = fastest_wall(walls, barrel),
               sheet = fastest_vertex(facet_surfaces),
               boundary = std::max(rigid, sheet);
  walls_travelled += rigid * time_step;
  sheets_travelled += sheet * time_step;
  stride = (fastest.moving + boundary) * time_step;
  travelled += stride;
  // Particles that follow facets have lists of their own for them.
  const double surrounding = follows_walls() ? rigid : boundary;
  margin.left -=
      (fastest.closing + std::max(fastest.closing, surrounding)) * time_step;
  facets_left -= (fastest.closing + sheet) * time_step;
  travel.centres += 2. * fastest.moving * time_step;
  travel.gaps += 2. * fastest.closing * time_step;
  // Seldom, since it counts the contacts.
  constexpr std::int64_t check_interval = 256;
  const bool is_checked = (step_count - margin.built_at) % check_interval == 0;
  if (lists_are_stale || margin.left < 0. ||
      (is_checked && margin.is_too_wide(list_counts())))
    rebuild_lists();
  else if (places_are_stale)
    check_displaced();
  else if (follows_walls() && !facet_surfaces.empty() &&
           (facets_are_stale || facets_left < 0.))
    check_facets();
}

SkinWidth::Lists Engine::list_counts() const
{
  return {step_count, static_cast<std::int64_t>(pair_batch.size()),
          count_touching(pair_batch), cost_of_list(pair_geometry())};
}

void Engine::rebuild_lists()
{
  const PhaseTimer timer(spent.search);
  if (keeps_inside)
    require_inside(walls, barrel, system);
  margin.renew(settings.geometry.usual_skin, list_counts());
  if (system.size() >= sorted_from)
    sort_in_space();
  renew_lists();
  steepest = branch_steepness();
  least_radius = system.size() > 0 ? system.smallest_radius() : 0.;
  lists_are_stale = false;
}

/// What is left of the margin stays: but for pairs whose places have displaced,
/// lists are as good as they were.
void Engine::check_displaced()
{
  const PhaseTimer timer(spent.search);
  renew_lists();
}

void Engine::renew_lists()
{
  update_maps();
  rebuild_pair_list();
  rebuild_plane_list();
  if (barrel.is_there())
    rebuild_drum_list();
  for (SurfaceContacts &facets : facet_surfaces)
    rebuild_facet_list(facets);
  places_are_stale = facets_are_stale = false;
  std::fill(pair_batch.reactivation.begin(), pair_batch.reactivation.end(), 0.);
  pair_loads.prepare(pair_batch);
  ++rebuild_count;
}

/// The lists of places on facets alone.
void Engine::check_facets()
{
  const PhaseTimer timer(spent.search);
  update_maps();
  for (SurfaceContacts &facets : facet_surfaces)
    rebuild_facet_list(facets);
  facets_are_stale = false;
  ++rebuild_count;
}

/// Of particles that broke since the last look, or of all after a restart.
void Engine::update_maps()
{
  if (pair_layout(settings, system).has_contact_points ||
      wall_layout(settings, settings.wall, system).has_contact_points)
    maps.update(system);
}

ContactGeometry Engine::pair_geometry() const
{
  return system.has_shapes ? settings.geometry.geometry
                           : ContactGeometry::sphere;
}

ContactPointSearchInput
Engine::contact_point_search(const ForceContext &still,
                             const BatchLayout &layout) const
{
  // Searched farther than the next look at the lists needs, so that only
  // particles that move are searched again then. Three times as far: places
  // that are born between two searches are found too late.
  constexpr double reserve = 2.;
  return {still,       maps,
          layout,      reserve * margin.width,
          margin.left, rebuild_count == 0};
}

void Engine::rebuild_pair_list()
{
  const BatchLayout layout = pair_layout(settings, system);
  if (layout.has_contact_points)
  {
    const ForceContext still = context(0.);
    contact_points.renew_pairs(contact_point_search(still, layout), travel,
                               pair_batch, lost);
    return;
  }
  rebuild_pairs(system, layout,
                pair_finder.find(system, pair_geometry(), margin.width, travel),
                pair_batch, lost);
}

void Engine::sort_in_space()
{
  // Anew when particles may have changed places with their neighbours.
  const double diameter = 2. * system.largest_radius();
  if (rebuild_count > 0 && travelled - travelled_sorted < diameter)
    return;
  travelled_sorted = travelled;
  const std::vector<std::int32_t> order =
      space_order(system.column(&ParticleState::position));
  system.reorder(order);
  pair_finder.forget();
  contact_points.renumber(places(order));
  reorder_column(work.damped, order);
  reorder_column(work.lifted, order);
  const std::vector<std::int32_t> place = places(order);
  renumber_pairs(place, pair_batch);
  renumber_planes(place, plane_batch);
  if (follows_walls())
  {
    renumber_drum_places(place, drum_batch, drum_walls);
    for (SurfaceContacts &facets : facet_surfaces)
    {
      renumber_facet_places(place, facets.candidates, facets.batch);
      renumber_candidates(place, facets.near_particles);
      facets.watch = {}; // rows take other numbers
    }
    return;
  }
  renumber_planes(place, drum_batch);
  for (SurfaceContacts &facets : facet_surfaces)
    renumber_facets(place, facets.candidates, facets.batch);
}

double Engine::branch_steepness() const
{
  return settings.geometry.geometry == ContactGeometry::radial
             ? steepness(system)
             : 0.;
}
} // namespace dem
