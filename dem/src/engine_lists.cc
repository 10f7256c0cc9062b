#include "engine_state.h"
#include "phase_timer.h"

#include <dem/integrate/verlet.h>
#include <dem/neighbor/candidates.h>
#include <dem/neighbor/space_order.h>
#include <dem/parallel/faults.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <stdexcept>
#include <utility>

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

/// The fastest point of the boundaries that deform, or of the others [m/s].
double fastest_point(const std::vector<std::unique_ptr<Boundary>> &boundaries,
                     bool deforms)
{
  double fastest = 0.;
  for (const auto &boundary : boundaries)
    if (boundary->deforms() == deforms)
      fastest = std::max(fastest, boundary->speed());
  return fastest;
}

/// From here on particles are put in spatial order: neighbours lie near each
/// other in the caches, and few loads go to particles of other ranges of
/// contacts and other threads.
constexpr std::size_t sorted_from = 128;

/// Open pairs are inactive, so they cost little.
SkinWidth::Cost cost_of_list(const GeometryTraits &geometry)
{
  return {geometry.rebuild_cost, geometry.open_pair_cost};
}

/// The first particle whose position, velocity, spin or orientation is no
/// finite number, before a list or a grid turns it into an address in memory;
/// empty: there is none.
std::string not_finite_fault(const ParticleSystem &particles, double time)
{
  for (std::size_t i = 0; i < particles.n_owned(); ++i)
  {
    const ParticleState &state = particles.state[i];
    const bool has_position = state.position.allFinite();
    if (has_position && state.velocity.allFinite() && state.spin.allFinite() &&
        particles.orientation(i).coeffs().allFinite())
      continue;
    char text[200];
    std::snprintf(text, sizeof text,
                  "particle %lld has %s that is not a finite number at %.8g s: "
                  "the step is too long, or an input is not a number",
                  static_cast<long long>(particles.id[i]),
                  has_position ? "a velocity or a spin" : "a position", time);
    return text;
  }
  return {};
}

/// Throws std::runtime_error where particles leap, before they are lost to all
/// lists and their positions to numbers.
void require_sane(double fastest, double time_step, double largest_radius)
{
  constexpr double most = 100.; // radii in one step
  const double leap = fastest * time_step;
  if (leap <= most * largest_radius)
    return;
  char text[160];
  std::snprintf(text, sizeof text,
                "particles move by %.3g m in a step of %.3g s, more than a "
                "hundred of their radii: the step is too long",
                leap, time_step);
  throw std::runtime_error(text);
}

bool deforms(const std::vector<std::unique_ptr<Boundary>> &boundaries)
{
  return std::ranges::any_of(boundaries, [](const auto &boundary)
                             { return boundary->deforms(); });
}

/// How far the point is beyond the boundaries [m]; below 0: inside.
double beyond(const std::vector<std::unique_ptr<Boundary>> &boundaries,
              const Vec3 &point)
{
  double most = -std::numeric_limits<double>::infinity();
  for (const auto &boundary : boundaries)
    most = std::max(most, boundary->beyond(point));
  return most;
}

/// The first particle of which all is beyond a wall: nothing would bring it
/// back. Empty: there is none.
std::string
escape_fault(const std::vector<std::unique_ptr<Boundary>> &boundaries,
             const ParticleSystem &system)
{
  for (std::size_t i = 0; i < system.n_owned(); ++i)
  {
    const Vec3 &at = system.position(i);
    if (beyond(boundaries, at) <= system.shape[i].circumscribed_radius)
      continue;
    char text[224];
    std::snprintf(
        text, sizeof text,
        "particle %d of %.3g g has come through a wall at (%.4g, %.4g, "
        "%.4g) m: the step is too long, or the particle too soft for "
        "what presses it",
        static_cast<int>(system.id[i]), 1e3 * system.mass(i), at.x(), at.y(),
        at.z());
    return text;
  }
  return {};
}

/// Upper bound of the lengths of the periodic cell between two particles, by
/// axis, while lists hold [-].
Vec3 span_in_lengths(const ParticleSystem &system)
{
  Vec3 span = Vec3::Zero();
  if (!system.cell.is_there() || system.size() == 0)
    return span;
  Vec3 lower = system.position(0), upper = lower;
  for (std::size_t i = 1; i < system.size(); ++i)
  {
    lower = lower.cwiseMin(system.position(i));
    upper = upper.cwiseMax(system.position(i));
  }
  for (int d = 0; d < 3; ++d)
    if (system.cell.is_periodic(d))
      span[d] = 1. + (upper[d] - lower[d]) / system.cell.length[d];
  return span;
}
} // namespace

void EngineState::keep_lists(const Speeds &fastest, double time_step)
{
  if (!fastest.is_finite)
  {
    stop_together<std::runtime_error>(distribution.ranks(),
                                      not_finite_fault(system, now));
    throw std::runtime_error(
        "a particle moves by a distance that is not finite");
  }
  require_sane(fastest.moving, time_step, largest_radius);
  const bool has_deforming_lists = follows_walls() && deforms(walls);
  schedule.advance({fastest.moving, fastest.closing,
                    fastest_point(walls, false), fastest_point(walls, true),
                    cell_speed()},
                   time_step, follows_walls());
  // Seldom, since it counts the contacts.
  constexpr std::int64_t check_interval = 256;
  const bool is_checked =
      (step_count - schedule.skin.built_at) % check_interval == 0;
  const auto is_too_wide = [&]
  { return is_checked && schedule.skin.is_too_wide(list_counts()); };
  switch (schedule.due(has_deforming_lists, is_too_wide))
  {
  case NeighborSchedule::Due::all:
    return rebuild_lists();
  case NeighborSchedule::Due::displaced:
    return renew_displaced_lists();
  case NeighborSchedule::Due::deforming:
    return renew_deforming_lists();
  case NeighborSchedule::Due::nothing:
    return;
  }
}

SkinWidth::Lists EngineState::list_counts() const
{
  std::array counts{static_cast<std::int64_t>(pair_batch.n_contacts()),
                    count_touching(pair_batch)};
  distribution.ranks().sum(counts);
  return {step_count, counts[0], counts[1],
          cost_of_list(traits(pair_geometry()))};
}

void EngineState::rebuild_lists()
{
  if (keeps_inside)
    stop_together<std::runtime_error>(distribution.ranks(),
                                      escape_fault(walls, system));
  note_extremes();
  schedule.skin.renew(usual_skin(), list_counts());
  if (!distribution.is_shared() && system.size() >= sorted_from)
    sort_in_space();
  renew_lists();
  image_span = span_in_lengths(system);
  schedule.skin_renewed();
}

/// What the schedule and the sums of loads take from all particles.
void EngineState::note_extremes()
{
  if (added_count == 0)
    return;
  const bool is_empty = system.n_owned() == 0;
  std::array largest{branch_steepness(),
                     is_empty ? -std::numeric_limits<double>::infinity()
                              : -system.smallest_radius(),
                     is_empty ? 0. : system.largest_radius(), overlap.recent,
                     overlap.largest};
  distribution.ranks().max(largest);
  steepest = largest[0];
  least_radius = -largest[1];
  largest_radius = largest[2];
  overlap = {largest[3], largest[4]};
  grid = sum_grid(grid_force, largest_radius);
}

/// From time to time forces may have fallen so far that loads need a smaller
/// spacing. When this is looked at must not depend on the lists.
void EngineState::keep_grid()
{
  constexpr std::int64_t interval = 4096; // steps
  if (grid_force > 0. && step_count % interval != 0)
    return;
  std::array largest{std::exchange(recent_force, 0.)};
  distribution.ranks().max(largest);
  note_forces(largest[0]);
}

/// Chooses the spacing of loads for contacts that have had forces of up to
/// `recent` [N] of late: with a reserve, and seldom another one.
void EngineState::note_forces(double recent)
{
  constexpr double reserve = 16., much = 1024.;
  std::vector<LawChoice> laws{law_of(settings.particle)};
  for (const auto &boundary : walls)
    laws.push_back(law_of(boundary->material));
  const double wanted =
      std::max(reserve * recent,
               usual_force(laws, elasticity, 1 + settings.other_solids.size(),
                           least_radius));
  if (wanted > grid_force || much * wanted < grid_force)
    grid_force = wanted;
  grid = sum_grid(grid_force, largest_radius);
}

/// But for pairs whose contact points have displaced, lists are as good as they
/// were, and what is left of the skin stays.
void EngineState::renew_displaced_lists()
{
  const PhaseTimer timer(spent.search);
  update_maps();
  if (follows_pairs())
  {
    const ForceContext still = context(0.);
    const bool keeps_order = contact_points.renew_displaced(
        contact_point_search(still, pair_batch.layout), schedule.paths,
        pair_batch, lost);
    if (!keeps_order)
      pair_loads.prepare(pair_batch);
  }
  find_boundary_candidates(false);
  schedule.lists_made();
}

void EngineState::renew_lists()
{
  const PhaseTimer timer(spent.search);
  if (distribution.is_shared() && needs_search())
    redistribute();
  update_maps();
  rebuild_pair_list();
  find_boundary_candidates(false);
  std::fill(pair_batch.reactivation.begin(), pair_batch.reactivation.end(), 0.);
  pair_loads.prepare(pair_batch);
  schedule.lists_made();
}

/// The lists of contact points on boundaries that deform alone.
void EngineState::renew_deforming_lists()
{
  const PhaseTimer timer(spent.search);
  update_maps();
  find_boundary_candidates(true);
  schedule.deforming_lists_made();
}

/// Of particles that broke since the last look, or of all after a restart.
void EngineState::update_maps()
{
  if (follows_pairs() || follows_walls())
    maps.update(system);
}

ContactGeometry EngineState::pair_geometry() const
{
  return system.has_shapes ? settings.geometry.geometry
                           : geometry_without_shapes;
}

/// Around what the skin is chosen. A search for contact points costs more, the
/// farther the surfaces are apart on which it begins [m].
double EngineState::usual_skin() const
{
  constexpr double of_radius = 0.05;
  const double usual = settings.geometry.usual_skin;
  return follows_pairs() ? std::min(usual, of_radius * least_radius) : usual;
}

/// How far beyond contact the lists of pairs look [m].
double EngineState::pair_skin() const
{
  return schedule.skin.width + pair_layout(settings, system).law.range();
}

/// Those of contact points are searched farther than the next check of the
/// lists needs, so that only particles that move are searched again then. Three
/// times as far: contact points that are born between two searches are found
/// too late [m].
double EngineState::contact_point_skin() const
{
  constexpr double reserve = 2.;
  return reserve * schedule.skin.width;
}

bool EngineState::follows_pairs() const
{
  return pair_layout(settings, system).has_contact_points;
}

/// Whether candidates of pairs are searched when lists are renewed.
bool EngineState::needs_search() const
{
  return follows_pairs()
             ? contact_points.needs_search(contact_point_skin(), schedule.paths)
             : pair_finder.needs_search(pair_skin(), schedule.paths);
}

ContactPointSearchInput
EngineState::contact_point_search(const ForceContext &still,
                                  const BatchLayout &layout) const
{
  return {still,
          maps,
          layout,
          contact_point_skin(),
          schedule.skin.left,
          schedule.n_made == 0};
}

void EngineState::rebuild_pair_list()
{
  const BatchLayout layout = pair_layout(settings, system);
  if (layout.has_contact_points)
  {
    const ForceContext still = context(0.);
    contact_points.renew_pairs(contact_point_search(still, layout),
                               schedule.paths, pair_batch, lost);
    return;
  }
  rebuild_pairs(
      system, layout,
      pair_finder.find(system, pair_geometry(), pair_skin(), schedule.paths),
      pair_batch, lost);
}

void EngineState::sort_in_space()
{
  // Again when particles may have moved past their neighbours.
  const double diameter = 2. * system.largest_radius();
  if (schedule.n_made > 0 && schedule.path_length - path_at_sort < diameter)
    return;
  path_at_sort = schedule.path_length;
  put_in_order(space_order(system.column(&ParticleState::position)));
}

/// Entry k of every column becomes entry order[k].
void EngineState::put_in_order(const std::vector<std::int32_t> &order)
{
  system.reorder(order);
  pair_finder.forget();
  reorder_column(work.damped, order);
  reorder_column(work.lifted, order);
  const std::vector<std::int32_t> new_row = new_rows(order);
  contact_points.renumber(new_row);
  renumber_pairs(new_row, pair_batch);
  for (const auto &boundary : walls)
    boundary->renumber(new_row);
}

double EngineState::branch_steepness() const
{
  return traits(settings.geometry.geometry).is_along_branch ? steepness(system)
                                                            : 0.;
}
} // namespace dem
