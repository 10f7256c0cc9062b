#pragma once

#include "contact_lanes.h"

/// Stone against wall, in lanes.
namespace dem::kernel
{
namespace
{
using WallLanes = LaneRows<wall_row>;

/// Where the fields of WallRow are; the inverse mass follows the last.
constexpr int at_point = 0, at_normal = 3, at_wall_velocity = 6,
              at_velocity_before = 9, at_normal_before = 12;

/// Contacts of one set of lanes as they lie.
struct WallGeometry
{
  LaneVector normal;
  Lanes distance; ///< centre to wall
  Lanes reach;    ///< of the stone towards it
  Lanes overlap;  ///< 0 where open
};

WallGeometry locate_walls(const Task &task, std::int64_t k, const StoneLanes &a,
                          const WallLanes &wall, const LaneMask &is_valid)
{
  WallGeometry geometry;
  geometry.normal = wall.vector(at_normal);
  const LaneQuad ball = a.quad(at_position);
  geometry.distance = dot(wall.vector(at_point) - ball.vector, geometry.normal);
  geometry.reach = ball.number;
  if (task.reads_surface)
  {
    const LaneMask is_near =
        is_valid && geometry.distance < far_wall * geometry.reach;
    const LaneVector direction = side_direction(a, geometry.normal);
    refresh_side(task, task.contacts.side_a, k, 0, direction, is_near);
    if (task.is_radial)
      geometry.reach = expanded_radius(task.contacts.side_a, k, direction);
  }
  Lanes overlap = geometry.reach - geometry.distance;
  if (task.wall_extra)
  {
    const std::int32_t *row = task.contacts.b + k;
    overlap +=
        Lanes([&task, row](auto lane) { return task.wall_extra[row[lane]]; });
  }
  geometry.overlap = select(is_valid, stdx::max(overlap, Lanes(0.)), Lanes(0.));
  return geometry;
}

/// Motion of the walls against the stones of one set of lanes.
ContactMotion<Lanes> wall_motion(const StoneLanes &a, const WallLanes &wall,
                                 const WallGeometry &geometry)
{
  const LaneVector spin = a.vector(at_spin);
  const LaneQuad moving = a.quad(at_velocity);
  ContactMotion<Lanes> motion;
  motion.normal = geometry.normal;
  const LaneQuad before = wall.quad(at_normal_before);
  motion.normal_before = before.vector;
  motion.velocity = wall.vector(at_wall_velocity) - moving.vector -
                    cross(spin, geometry.distance * geometry.normal);
  // An open contact was where the stone would touch.
  const Lanes arm = stdx::min(geometry.distance, geometry.reach);
  motion.velocity_before = wall.vector(at_velocity_before) - moving.vector -
                           cross(spin, arm * motion.normal_before);
  motion.spin = -spin;
  motion.reduced_mass = moving.number / (1. + moving.number * before.number);
  motion.rolling_radius = arm;
  return motion;
}

void scatter_walls(const Task &task, std::int64_t k, int n_valid,
                   const LaneVector &force, const LaneVector &moment,
                   const Target &target)
{
  LaneTable<8> table;
  table.set(0, {force, moment.x});
  table.set(4, {{moment.y, moment.z, Lanes(0.)}});
  for (int lane = 0; lane < n_valid; ++lane)
  {
    const double *load = table.value[lane];
    double *kept = task.contacts.load + load_row * (k + lane);
    store_pack(load_pack<4>(load), kept);
    store_pack(load_pack<2>(load + 4), kept + 4);
    add_load(load, load + 4, target.row(task, task.contacts.a[k + lane]));
  }
}

/// The normal spring: of the surface or the ball on a rigid plate, or linear.
NormalSpring<Lanes> wall_spring(const Task &task, std::int64_t k,
                                const WallGeometry &geometry)
{
  if (!task.is_hertz)
    return linear_spring(task.normal_factor, task.shear_factor,
                         geometry.overlap);
  if (task.reads_surface)
    return hertz_spring(load(task.contacts.normal_prefactor + k),
                        load(task.contacts.shear_prefactor + k),
                        geometry.overlap);
  const Lanes root = stdx::sqrt(geometry.reach);
  return hertz_spring(Lanes(task.normal_factor * root),
                      Lanes(task.shear_factor * root), geometry.overlap);
}

/// History of contacts with walls and the overlaps of the last step.
struct WallHistory
{
  Lanes overlap;
  ContactHistory<Lanes> springs;
};

WallHistory load_wall_history(const Task &task, std::int64_t k)
{
  WallHistory history{load(task.contacts.overlap + k), {}};
  history.springs = load_history(task.contacts, k, history.overlap);
  if (!task.is_hertz)
    history.springs.normal_energy =
        linear_energy(task.normal_factor, history.overlap);
  return history;
}

/// Takes from linear springs what they give too much where a contact begins or
/// ends within the step: its last normal force is taken back by a pull, its
/// first shear force is that of the way since it began.
void cut_at_crossing(const Task &task, const ContactMotion<Lanes> &motion,
                     const Lanes &overlap, const WallHistory &before,
                     NormalSpring<Lanes> &spring)
{
  const LaneMask begins = overlap > 0. && before.overlap <= 0.,
                 ends = before.overlap > 0. && overlap <= 0.;
  if (!any(begins || ends))
    return;
  const double dt = task.time_step;
  const Lanes stiffness = task.normal_factor * dt * dt / motion.reduced_mass;
  const Lanes closed = -dt * dot(motion.velocity, motion.normal);
  spring.first_share =
      select(begins, overlap / stdx::max(overlap, closed), Lanes(1.));
  const Lanes opened = dt * dot(motion.velocity_before, motion.normal_before);
  const Lanes pressing = before.springs.normal_force -
                         dot(before.springs.dashpot, motion.normal_before);
  spring.force -=
      select(begins,
             spring.force * part_before_begin<Lanes>(
                                {overlap, closed - overlap, stiffness}),
             Lanes(0.)) +
      select(ends,
             pressing *
                 part_after_end<Lanes>(
                     {before.overlap, opened - before.overlap, stiffness}),
             Lanes(0.));
}

/// One step of the law at walls; the springs go into `history`.
LaneVector advance_wall_contact(const Task &task,
                                const ContactMotion<Lanes> &motion,
                                const Lanes &overlap,
                                NormalSpring<Lanes> spring,
                                WallHistory &history, Losses<Lanes> &lost)
{
  if (!task.is_hertz)
    cut_at_crossing(task, motion, overlap, history, spring);
  return advance_contact(motion, spring, task.coefficients, task.time_step,
                         history.springs, lost);
}

/// Whether some of the contacts have loads now or had them in the last step.
bool any_loaded(const Task &task, std::int64_t k, const Lanes &overlap)
{
  return any(overlap > 0. || load(task.contacts.normal_force + k) != 0.);
}

[[gnu::flatten]] void advance_walls(const Task &task, std::int64_t k,
                                    int n_valid, Losses<Lanes> &lost,
                                    const Target &target)
{
  const Contacts &contacts = task.contacts;
  const StoneLanes a(task.stones.state, contacts.a + k);
  const WallLanes wall(task.walls, contacts.b + k);
  const WallGeometry geometry =
      locate_walls(task, k, a, wall, valid_lanes(n_valid));
  if (!any_loaded(task, k, geometry.overlap))
    return;
  WallHistory history = load_wall_history(task, k);
  const ContactHistory<Lanes> &springs = history.springs;
  const Lanes energy_before = springs.normal_energy;
  LaneVector force;
  if (task.adds_loads_only)
    force = kept_force(springs, geometry.normal);
  else
  {
    force = advance_wall_contact(task, wall_motion(a, wall, geometry),
                                 geometry.overlap,
                                 wall_spring(task, k, geometry), history, lost);
    store_history(springs, contacts, k);
    store(geometry.overlap, contacts.overlap + k);
  }
  scatter_walls(task, k, n_valid, force,
                cross(geometry.distance * geometry.normal, force) +
                    springs.rolling,
                target);
  if (task.has_damage)
    find_damage(task, k,
                {geometry.overlap, energy_before, springs.normal_energy},
                target.sum);
}
} // namespace
} // namespace dem::kernel
