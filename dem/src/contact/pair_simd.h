#pragma once

#include "contact_simd.h"

/// Particle against particle, in lanes.
namespace dem::kernel
{
namespace
{
/// Path length of the particles of each pair, both together.
Simd path_of_pairs(const Task &task, std::int64_t k)
{
  const double *path_length = task.particles.path_length;
  if (!path_length)
    return Simd(task.particles.gap_path);
  const std::int32_t *a = task.contacts.a + k, *b = task.contacts.b + k;
  const Simd both([=](auto lane)
                  { return path_length[a[lane]] + path_length[b[lane]]; });
  return both + task.particles.cell_path;
}

/// Contacts that cannot touch yet. Nothing of them changes, whatever the lanes
/// beside them do.
SimdMask inactive(const Task &task, std::int64_t k)
{
  const Simd reactivation = load(task.contacts.reactivation + k);
  const SimdMask is_inactive = reactivation > 0.;
  return any(is_inactive) ? is_inactive && path_of_pairs(task, k) < reactivation
                          : is_inactive;
}

/// Active contacts that are apart by more than 0 become inactive until their
/// particles have moved so far.
void deactivate(const Task &task, std::int64_t k, const SimdMask &is_active,
                const Simd &apart)
{
  const Simd reactivation = load(task.contacts.reactivation + k);
  const SimdMask is_open = is_active && apart > 0.;
  if (any(is_open || (is_active && reactivation > 0.)))
    store(select(is_active,
                 select(is_open, path_of_pairs(task, k) + apart, Simd(0.)),
                 reactivation),
          task.contacts.reactivation + k);
}

/// How many lengths of the periodic cell lie between the particles B and the
/// images that are in contact.
SimdVector images_of(const Task &task, const SimdVector &branch)
{
  const auto along = [&task](int axis, const Simd &x)
  {
    return task.cell_length[axis] > 0.
               ? stdx::nearbyint(Simd(x / task.cell_length[axis]))
               : Simd(0.);
  };
  return {along(0, branch.x), along(1, branch.y), along(2, branch.z)};
}

SimdVector times(const double *factors, const SimdVector &v)
{
  return {factors[0] * v.x, factors[1] * v.y, factors[2] * v.z};
}

/// Adds what the forces on A across the faces of the cell do by its lengths:
/// lane by lane, in the order of the contacts.
void add_cell_force(const SimdVector &images, const SimdVector &force,
                    int n_valid, RangeSum &sum)
{
  if (!any(images.x != 0. || images.y != 0. || images.z != 0.))
    return;
  for (int lane = 0; lane < n_valid; ++lane)
  {
    const auto k = static_cast<std::size_t>(lane);
    sum.cell_force[0] -= images.x[k] * force.x[k];
    sum.cell_force[1] -= images.y[k] * force.y[k];
    sum.cell_force[2] -= images.z[k] * force.z[k];
  }
}

/// Contacts of one set of lanes as they lie.
struct PairGeometry
{
  SimdVector images; ///< of a periodic cell, see images_of()
  SimdVector normal;
  Simd inverse_distance;   ///< of the centres; 0 where they coincide
  Simd radius_a, radius_b; ///< towards each other
  Simd gap;                ///< < 0: an overlap
  Simd overlap;            ///< 0 where open

  /// From the centres to the middle of the overlap.
  Simd arm_a() const { return radius_a - 0.5 * overlap; }
  Simd arm_b() const { return radius_b - 0.5 * overlap; }
};

PairGeometry locate_pairs(const Task &task, std::int64_t k,
                          const ParticleSimd &a, const ParticleSimd &b,
                          const SimdMask &is_active)
{
  const SimdQuad ball_a = a.quad(at_position), ball_b = b.quad(at_position);
  SimdVector branch = ball_b.vector - ball_a.vector;
  PairGeometry pair;
  if (task.is_periodic)
  {
    pair.images = images_of(task, branch);
    branch = branch - times(task.cell_length, pair.images);
  }
  const Simd square = dot(branch, branch);
  // Entries that only fill the last block lie on themselves.
  const SimdMask is_apart = square > 0.;
  const Simd distance = stdx::sqrt(square);
  pair.inverse_distance =
      select(is_apart, 1. / select(is_apart, distance, Simd(1.)), Simd(0.));
  pair.normal = pair.inverse_distance * branch;
  if (task.reads_surface)
  {
    const SimdVector on_a = side_direction(a, pair.normal);
    const SimdVector on_b = side_direction(b, -pair.normal);
    const SimdMask is_looked_at = is_apart && is_active;
    refresh_side(task, task.contacts.side_a, k, 0, on_a, is_looked_at);
    refresh_side(task, task.contacts.side_b, k, 1, on_b, is_looked_at);
    if (task.is_radial)
    {
      pair.radius_a = expanded_radius(task.contacts.side_a, k, on_a);
      pair.radius_b = expanded_radius(task.contacts.side_b, k, on_b);
    }
  }
  if (!task.is_radial)
  {
    pair.radius_a = ball_a.number;
    pair.radius_b = ball_b.number;
  }
  const Simd depth = pair.radius_a + pair.radius_b - distance;
  pair.gap = -depth;
  pair.overlap =
      select(is_apart && is_active, stdx::max(depth, Simd(0.)), Simd(0.));
  return pair;
}

/// Mixes the prefactors again where the particles have turned about the normal.
void refresh_prefactors(const Task &task, std::int64_t k,
                        const SimdVector &normal, const SimdMask &is_touching,
                        const Simd &spin)
{
  const Contacts &contacts = task.contacts;
  const Simd torsion_angle =
      load(contacts.torsion_angle + k) +
      select(is_touching, stdx::abs(spin) * task.time_step, Simd(0.));
  store(torsion_angle, contacts.torsion_angle + k);
  const SimdMask is_old = is_touching && torsion_angle > task.refresh_tolerance;
  if (!any(is_old))
    return;
  SimdTable<4> table;
  table.set(0, {normal});
  for (int lane = 0; lane < n_lanes; ++lane)
    if (is_old[static_cast<std::size_t>(lane)])
      task.surfaces.mix(task.surfaces.owner, k + lane, table.value[lane]);
}

/// Force on particle A, minus that on B, and moments on both.
struct PairLoad
{
  SimdVector force, moment_a, moment_b;

  /// Rounded, so that sums are exact.
  PairLoad(const Task &task, const SimdVector &force_on_a,
           const SimdVector &moment_on_a, const SimdVector &moment_on_b)
      : force(on_grid(force_on_a, task.force_shift)),
        moment_a(on_grid(moment_on_a, task.moment_shift)),
        moment_b(on_grid(moment_on_b, task.moment_shift))
  {
  }
};

void scatter_pairs(const Task &task, std::int64_t k, int n_valid,
                   const PairLoad &load, const Target &target)
{
  // What is read in one piece was written in one: it need not wait for memory.
  SimdTable<12> table;
  table.set(0, {load.force, load.moment_a.x});
  table.set(4, {-load.force, load.moment_b.x});
  table.set(8, {{load.moment_a.y, load.moment_a.z, load.moment_b.y},
                load.moment_b.z});
  for (int lane = 0; lane < n_valid; ++lane)
  {
    const double *of = table.value[lane];
    add_load(of, of + 8, target.row(task, task.contacts.a[k + lane]));
    add_load(of + 4, of + 10,
             partner_load(task, task.contacts.target[k + lane]));
  }
}

/// Motion of side B against side A of one set of lanes.
ContactMotion<Simd> pair_motion(const Task &task, const ParticleSimd &a,
                                const ParticleSimd &b, const PairGeometry &pair)
{
  const SimdVector spin_a = a.vector(at_spin), spin_b = b.vector(at_spin);
  const SimdQuad moving_a = a.quad(at_velocity), moving_b = b.quad(at_velocity);
  SimdVector parting = moving_b.vector - moving_a.vector;
  if (task.is_periodic)
    parting = parting - times(task.cell_rate, pair.images);
  ContactMotion<Simd> motion;
  motion.normal = pair.normal;
  // The centres have parted along straight lines in this step.
  motion.normal_before =
      pair.normal - pair.inverse_distance * Simd(task.time_step) *
                        (parting - dot(parting, pair.normal) * pair.normal);
  motion.velocity = motion.velocity_before =
      parting -
      cross(pair.arm_a() * spin_a + pair.arm_b() * spin_b, pair.normal);
  motion.spin = spin_b - spin_a;
  motion.reduced_mass =
      moving_a.number * moving_b.number / (moving_a.number + moving_b.number);
  // In contact the sum of both arms is the distance of the centres.
  motion.rolling_radius = pair.arm_a() * pair.arm_b() * pair.inverse_distance;
  return motion;
}

/// The normal spring: prefactors of the surfaces, or of two spheres. `overlap`
/// is below 0 at a gap where the law attracts.
template <class Law>
NormalSpring<Simd> pair_spring(const Task &task, std::int64_t k,
                               const PairGeometry &pair, const Simd &overlap,
                               const ContactMotion<Simd> &motion)
{
  const SimdMask is_near = overlap > -task.range;
  if (task.reads_surface)
  {
    refresh_prefactors(task, k, pair.normal, is_near,
                       dot(motion.spin, pair.normal));
    return mixed_spring<Law>(task, k, overlap);
  }
  // Entries that only fill the last block have no radius.
  const Simd radius = pair.radius_a * pair.radius_b /
                      select(is_near, pair.radius_a + pair.radius_b, Simd(1.));
  return sphere_spring<Law>(task, radius, overlap);
}

/// One step of `n_valid` contacts from k.
template <class Law>
[[gnu::flatten]] void advance_pairs(const Task &task, std::int64_t k,
                                    int n_valid, LaneSums &sums,
                                    const Target &target)
{
  const Contacts &contacts = task.contacts;
  const SimdMask is_active = !inactive(task, k);
  if (!any(is_active))
    return;
  const ParticleSimd a(task.particles.state, contacts.a + k),
      b(task.particles.state, contacts.b + k);
  const PairGeometry pair = locate_pairs(task, k, a, b, is_active);
  Simd overlap = pair.overlap, apart = pair.gap;
  if constexpr (Law::attracts)
  {
    const SimdMask is_there = is_active && pair.inverse_distance > 0.;
    overlap = select(is_there, Simd(-pair.gap), Simd(-task.range));
    apart = pair.gap - task.range;
  }
  deactivate(task, k, is_active, apart);
  const Simd overlap_before = load(contacts.overlap + k);
  if (!any_alive<Law>(task, k, overlap + task.range, overlap_before))
    return; // all is zero and stays so
  ContactHistory<Simd> history = load_history<Law>(task, k, overlap_before);
  const Simd energy_before = elastic_energy<Law>(task, history, overlap_before);
  SimdVector force;
  if (task.adds_loads_only)
    force = kept_force(history, pair.normal);
  else
  {
    const ContactMotion<Simd> motion = pair_motion(task, a, b, pair);
    force = advance_law<Law>(task, motion, pair.overlap, overlap_before,
                             pair_spring<Law>(task, k, pair, overlap, motion),
                             history, sums);
    store_history<Law>(history, contacts, k);
    store(pair.overlap, contacts.overlap + k);
  }
  const SimdVector turning = cross(pair.normal, force);
  const PairLoad load(task, force, pair.arm_a() * turning + history.rolling,
                      pair.arm_b() * turning - history.rolling);
  scatter_pairs(task, k, n_valid, load, target);
  sums.note(load.force);
  if (task.is_periodic)
    add_cell_force(pair.images, load.force, n_valid, target.sum);
  if (task.has_damage)
    find_damage(task, k,
                {pair.overlap, energy_before,
                 elastic_energy<Law>(task, history, pair.overlap)},
                target.sum);
}
} // namespace
} // namespace dem::kernel
