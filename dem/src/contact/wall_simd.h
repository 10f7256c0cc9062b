#pragma once

#include "contact_simd.h"

/// Particle against wall, in lanes.
namespace dem::kernel
{
namespace
{
using WallSimd = SimdRows<wall_row>;

/// Where the fields of WallRow are; the inverse mass follows the last.
constexpr int at_point = 0, at_normal = 3, at_wall_velocity = 6,
              at_velocity_before = 9, at_normal_before = 12;

/// Contacts of one set of lanes as they lie.
struct WallGeometry
{
  SimdVector normal;
  Simd distance; ///< centre to wall
  Simd reach;    ///< of the particle towards it
  Simd gap;      ///< < 0: an overlap
  Simd overlap;  ///< 0 where open
};

WallGeometry locate_walls(const Task &task, std::int64_t k,
                          const ParticleSimd &a, const WallSimd &wall,
                          const SimdMask &is_valid)
{
  WallGeometry geometry;
  geometry.normal = wall.vector(at_normal);
  const SimdQuad sphere = a.quad(at_position);
  geometry.distance =
      dot(wall.vector(at_point) - sphere.vector, geometry.normal);
  geometry.reach = sphere.number;
  if (task.reads_surface)
  {
    const SimdMask is_near =
        is_valid && geometry.distance < far_wall * geometry.reach;
    const SimdVector direction = side_direction(a, geometry.normal);
    refresh_side(task, task.contacts.side_a, k, 0, direction, is_near);
    if (task.is_radial)
      geometry.reach = expanded_radius(task.contacts.side_a, k, direction);
  }
  Simd overlap = geometry.reach - geometry.distance;
  if (task.wall_extra)
  {
    const std::int32_t *row = task.contacts.b + k;
    overlap +=
        Simd([&task, row](auto lane) { return task.wall_extra[row[lane]]; });
  }
  geometry.gap = -overlap;
  geometry.overlap = select(is_valid, stdx::max(overlap, Simd(0.)), Simd(0.));
  return geometry;
}

/// Motion of the walls against the particles of one set of lanes.
ContactMotion<Simd> wall_motion(const ParticleSimd &a, const WallSimd &wall,
                                const WallGeometry &geometry)
{
  const SimdVector spin = a.vector(at_spin);
  const SimdQuad moving = a.quad(at_velocity);
  ContactMotion<Simd> motion;
  motion.normal = geometry.normal;
  const SimdQuad before = wall.quad(at_normal_before);
  motion.normal_before = before.vector;
  motion.velocity = wall.vector(at_wall_velocity) - moving.vector -
                    cross(spin, geometry.distance * geometry.normal);
  // An open contact was where the particle would touch.
  const Simd arm = stdx::min(geometry.distance, geometry.reach);
  motion.velocity_before = wall.vector(at_velocity_before) - moving.vector -
                           cross(spin, arm * motion.normal_before);
  motion.spin = -spin;
  motion.reduced_mass = moving.number / (1. + moving.number * before.number);
  motion.rolling_radius = arm;
  return motion;
}

void scatter_walls(const Task &task, std::int64_t k, int n_valid,
                   const SimdVector &exact_force,
                   const SimdVector &exact_moment, const Target &target)
{
  // Rounded, so that sums are exact.
  const SimdVector force = on_grid(exact_force, task.force_shift),
                   moment = on_grid(exact_moment, task.moment_shift);
  SimdTable<8> table;
  table.set(0, {force, moment.x});
  table.set(4, {{moment.y, moment.z, Simd(0.)}});
  for (int lane = 0; lane < n_valid; ++lane)
  {
    const double *load = table.value[lane];
    double *kept = task.contacts.load + load_row * (k + lane);
    store_pack(load_pack<4>(load), kept);
    store_pack(load_pack<2>(load + 4), kept + 4);
    add_load(load, load + 4, target.row(task, task.contacts.a[k + lane]));
  }
}

/// The normal spring at an overlap, or a gap below 0 where the law attracts.
template <class Law>
NormalSpring<Simd> wall_spring(const Task &task, std::int64_t k,
                               const Simd &radius, const Simd &overlap)
{
  return task.reads_surface ? mixed_spring<Law>(task, k, overlap)
                            : sphere_spring<Law>(task, radius, overlap);
}

/// Whether some of the contacts have loads now or had them in the last step.
bool any_loaded(const Task &task, std::int64_t k, const Simd &overlap)
{
  return any(overlap > 0. || load(task.contacts.normal_force + k) != 0.);
}

template <class Law>
[[gnu::flatten]] void advance_walls(const Task &task, std::int64_t k,
                                    int n_valid, LaneSums &sums,
                                    const Target &target)
{
  const Contacts &contacts = task.contacts;
  const ParticleSimd a(task.particles.state, contacts.a + k);
  const WallSimd wall(task.walls, contacts.b + k);
  const SimdMask is_valid = valid_lanes(n_valid);
  const WallGeometry geometry = locate_walls(task, k, a, wall, is_valid);
  Simd signed_overlap = geometry.overlap;
  if constexpr (Law::attracts)
    signed_overlap = select(is_valid, Simd(-geometry.gap), Simd(-task.range));
  if (!any_loaded(task, k, signed_overlap + task.range))
    return;
  const Simd overlap_before = load(contacts.overlap + k);
  ContactHistory<Simd> history = load_history<Law>(task, k, overlap_before);
  const Simd energy_before = elastic_energy<Law>(task, history, overlap_before);
  SimdVector force;
  if (task.adds_loads_only)
    force = kept_force(history, geometry.normal);
  else
  {
    force = advance_law<Law>(
        task, wall_motion(a, wall, geometry), geometry.overlap, overlap_before,
        wall_spring<Law>(task, k, geometry.reach, signed_overlap), history,
        sums);
    store_history<Law>(history, contacts, k);
    store(geometry.overlap, contacts.overlap + k);
  }
  sums.note(force);
  scatter_walls(task, k, n_valid, force,
                cross(geometry.distance * geometry.normal, force) +
                    history.rolling,
                target);
  if (task.has_damage)
    find_damage(task, k,
                {geometry.overlap, energy_before,
                 elastic_energy<Law>(task, history, geometry.overlap)},
                target.sum);
}
} // namespace
} // namespace dem::kernel
