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
                   const SimdVector &force, const SimdVector &moment,
                   const Target &target)
{
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

/// The normal spring: of the surface or the sphere on a rigid plate, or linear.
NormalSpring<Simd> wall_spring(const Task &task, std::int64_t k,
                               const WallGeometry &geometry)
{
  if (!task.is_hertz)
    return linear_spring(task.normal_factor, task.shear_factor,
                         geometry.overlap);
  if (task.reads_surface)
    return hertz_spring(load(task.contacts.normal_prefactor + k),
                        load(task.contacts.shear_prefactor + k),
                        geometry.overlap);
  const Simd root = stdx::sqrt(geometry.reach);
  return hertz_spring(Simd(task.normal_factor * root),
                      Simd(task.shear_factor * root), geometry.overlap);
}

/// History of contacts with walls and the overlaps of the last step.
struct WallHistory
{
  Simd overlap;
  ContactHistory<Simd> springs;
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
void cut_at_crossing(const Task &task, const ContactMotion<Simd> &motion,
                     const Simd &overlap, const WallHistory &before,
                     NormalSpring<Simd> &spring)
{
  const SimdMask begins = overlap > 0. && before.overlap <= 0.,
                 ends = before.overlap > 0. && overlap <= 0.;
  if (!any(begins || ends))
    return;
  const double dt = task.time_step;
  const Simd stiffness = task.normal_factor * dt * dt / motion.reduced_mass;
  const Simd closed = -dt * dot(motion.velocity, motion.normal);
  spring.first_share =
      select(begins, overlap / stdx::max(overlap, closed), Simd(1.));
  const Simd opened = dt * dot(motion.velocity_before, motion.normal_before);
  const Simd pressing = before.springs.normal_force -
                        dot(before.springs.dashpot, motion.normal_before);
  spring.force -=
      select(begins,
             spring.force * part_before_begin<Simd>(
                                {overlap, closed - overlap, stiffness}),
             Simd(0.)) +
      select(ends,
             pressing *
                 part_after_end<Simd>(
                     {before.overlap, opened - before.overlap, stiffness}),
             Simd(0.));
}

/// One step of the law at walls; the springs go into `history`.
SimdVector advance_wall_contact(const Task &task,
                                const ContactMotion<Simd> &motion,
                                const Simd &overlap, NormalSpring<Simd> spring,
                                WallHistory &history, Losses<Simd> &lost)
{
  if (!task.is_hertz)
    cut_at_crossing(task, motion, overlap, history, spring);
  return advance_contact(motion, spring, task.coefficients, task.time_step,
                         history.springs, lost);
}

/// Whether some of the contacts have loads now or had them in the last step.
bool any_loaded(const Task &task, std::int64_t k, const Simd &overlap)
{
  return any(overlap > 0. || load(task.contacts.normal_force + k) != 0.);
}

[[gnu::flatten]] void advance_walls(const Task &task, std::int64_t k,
                                    int n_valid, Losses<Simd> &lost,
                                    const Target &target)
{
  const Contacts &contacts = task.contacts;
  const ParticleSimd a(task.particles.state, contacts.a + k);
  const WallSimd wall(task.walls, contacts.b + k);
  const WallGeometry geometry =
      locate_walls(task, k, a, wall, valid_lanes(n_valid));
  if (!any_loaded(task, k, geometry.overlap))
    return;
  WallHistory history = load_wall_history(task, k);
  const ContactHistory<Simd> &springs = history.springs;
  const Simd energy_before = springs.normal_energy;
  SimdVector force;
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
