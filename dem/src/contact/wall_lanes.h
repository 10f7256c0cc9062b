#pragma once

#include "contact_lanes.h"

/// Stone against wall, in lanes.
namespace dem::kernel
{
namespace
{
using WallLanes = LaneRows<wall_row>;

/// Where the fields of WallRow are.
constexpr int at_point = 0, at_normal = 3, at_wall_velocity = 6,
              at_velocity_before = 9, at_normal_before = 12,
              at_inverse_mass = 15;

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
  geometry.distance =
      dot(wall.vector(at_point) - a.vector(at_position), geometry.normal);
  geometry.reach = a.number(at_radius);
  if (task.reads_surface)
  {
    const LaneMask is_near =
        is_valid && geometry.distance < far_wall * geometry.reach;
    const LaneVector direction = side_direction(a, geometry.normal);
    refresh_side(task, task.contacts.side_a, k, 0, direction, is_near);
    if (task.is_radial)
      geometry.reach = expanded_radius(task.contacts.side_a, k, direction);
  }
  geometry.overlap =
      select(is_valid, stdx::max(geometry.reach - geometry.distance, Lanes(0.)),
             Lanes(0.));
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
  motion.normal_before = wall.vector(at_normal_before);
  motion.velocity = wall.vector(at_wall_velocity) - moving.vector -
                    cross(spin, geometry.distance * geometry.normal);
  // An open contact was where the stone would touch.
  motion.velocity_before =
      wall.vector(at_velocity_before) - moving.vector -
      cross(spin, stdx::min(geometry.distance, geometry.reach) *
                      motion.normal_before);
  motion.spin = -spin;
  motion.reduced_mass =
      moving.number / (1. + moving.number * wall.number(at_inverse_mass));
  motion.rolling_radius = geometry.reach;
  return motion;
}

void scatter_walls(const Task &task, std::int64_t k, int n_valid,
                   const LaneVector &force, const LaneVector &moment,
                   const Target &target)
{
  LaneTable<6> table;
  table.set(0, force);
  table.set(3, moment);
  for (int lane = 0; lane < n_valid; ++lane)
  {
    double *row = task.contacts.load + load_row * (k + lane);
    for (int c = 0; c < 6; ++c)
      row[c] = table.value[c][lane];
    add_load(table, 0, lane, target.row(task, task.contacts.a[k + lane]));
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

[[gnu::flatten]] void advance_walls(const Task &task, std::int64_t k,
                                    int n_valid, Losses<Lanes> &lost,
                                    const Target &target)
{
  const Contacts &contacts = task.contacts;
  const StoneLanes a(task.stones.state, contacts.a + k);
  const WallLanes wall(task.walls, contacts.b + k);
  const WallGeometry geometry =
      locate_walls(task, k, a, wall, valid_lanes(n_valid));
  const Lanes overlap_before = load(contacts.overlap + k);
  if (!any(geometry.overlap > 0. || overlap_before > 0.))
    return;
  ContactHistory<Lanes> history =
      load_history(contacts, k, overlap_before,
                   task.is_hertz ? hertz_energy_share : linear_energy_share);
  const Lanes energy_before = history.normal_energy;
  LaneVector force;
  if (task.adds_loads_only)
    force = kept_force(history, geometry.normal);
  else
  {
    force = advance_contact(wall_motion(a, wall, geometry),
                            wall_spring(task, k, geometry), task.coefficients,
                            task.time_step, history, lost);
    store_history(history, contacts, k);
    store(geometry.overlap, contacts.overlap + k);
  }
  scatter_walls(task, k, n_valid, force,
                cross(geometry.distance * geometry.normal, force) +
                    history.rolling,
                target);
  if (task.has_damage)
    find_damage(task, k,
                {geometry.overlap, energy_before, history.normal_energy},
                target.sum);
}
} // namespace
} // namespace dem::kernel
