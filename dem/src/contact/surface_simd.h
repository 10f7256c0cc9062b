#pragma once

#include "pair_simd.h"
#include "simd_surface.h"
#include "wall_simd.h"

/// Particles that meet with their true surfaces: every contact follows its
/// common normal by one Newton step per time step, in lanes.
namespace dem::kernel
{
namespace
{
/// None in the other lanes.
SimdPlanar only(const SimdMask &mask, const SimdPlanar &v)
{
  return {select(mask, v.x, Simd(0.)), select(mask, v.y, Simd(0.))};
}

/// Result of the Newton step of a set of lanes.
struct LaneStep
{
  SimdPlanar on_a, on_b;
  Simd overlap;      ///< there, to second order; < 0: a gap
  SimdMask is_sound; ///< K_A + K_B is positive and the step is short
};

/// Solves (K_A + K_B - delta K_B K_A) a = -m - K_B t, as newton_step() does.
LaneStep step_to_normal(const SimdShapeOperator &a, const SimdShapeOperator &b,
                        const SimdPlanar &t, const SimdPlanar &m,
                        const Simd &overlap)
{
  const SimdMatrix &ka = a.matrix, &kb = b.matrix;
  const SimdMatrix lens{ka.xx + kb.xx, ka.xy + kb.xy, ka.yy + kb.yy};
  const SimdPlanar kb_t = kb * t;
  const SimdPlanar right{-m.x - kb_t.x, -m.y - kb_t.y};
  // K_B K_A is not symmetric.
  const Simd xx = lens.xx - overlap * (kb.xx * ka.xx + kb.xy * ka.xy);
  const Simd xy = lens.xy - overlap * (kb.xx * ka.xy + kb.xy * ka.yy);
  const Simd yx = lens.xy - overlap * (kb.xy * ka.xx + kb.yy * ka.xy);
  const Simd yy = lens.yy - overlap * (kb.xy * ka.xy + kb.yy * ka.yy);
  const Simd determinant = xx * yy - xy * yx;
  LaneStep step;
  step.is_sound = lens.xx > 0. && lens.determinant() > 0. && determinant > 0.;
  const Simd inverse = 1. / select(step.is_sound, determinant, Simd(1.));
  step.on_a = {inverse * (yy * right.x - xy * right.y),
               inverse * (xx * right.y - yx * right.x)};
  const SimdPlanar ka_a = ka * step.on_a;
  step.on_b = {step.on_a.x - overlap * ka_a.x + t.x,
               step.on_a.y - overlap * ka_a.y + t.y};
  const SimdPlanar aside{step.on_a.x + t.x, step.on_a.y + t.y};
  step.overlap = overlap - 0.5 * dot(step.on_a, ka_a) - dot(m, aside) -
                 0.5 * dot(aside, kb * aside);
  return step;
}

/// Notes where the contact is now: the point x of the surface in the body frame
/// as an offset from the direction u of the expansion, x / (x.u) - u.
void follow_side(const Task &task, const Side &side, std::int64_t k, int which,
                 const SimdVector &point, const SimdMask &is_followed)
{
  const SimdVector u = load_vector(side.direction, k);
  const Simd along = dot(point, u);
  const SimdMask is_valid = is_followed && along > 0.;
  const SimdVector offset = 1. / select(is_valid, along, Simd(1.)) * point - u;
  const SimdVector before = load_vector(side.offset, k);
  const SimdVector kept{select(is_valid, offset.x, before.x),
                        select(is_valid, offset.y, before.y),
                        select(is_valid, offset.z, before.z)};
  store_vector(kept, side.offset, k);
  const SimdMask is_stale =
      is_valid &&
      dot(kept, kept) > task.refresh_tolerance * task.refresh_tolerance;
  if (!any(is_stale))
    return;
  SimdTable<4> table;
  table.set(0, {u + kept});
  for (int lane = 0; lane < n_lanes; ++lane)
    if (is_stale[static_cast<std::size_t>(lane)])
      task.surfaces.renew(task.surfaces.owner, k + lane, which,
                          table.value[lane]);
}

SimdVector planar_in_body(const SimdShapeOperator &shape_operator,
                          const SimdPlanar &v)
{
  return v.x * shape_operator.first.vector + v.y * shape_operator.second.vector;
}

SimdVector planar_in_world(const SimdFrame &frame, const SimdPlanar &v)
{
  return v.x * frame.first + v.y * frame.second;
}

/// Has the contacts of some lanes searched again, one by one.
void relocate(const Task &task, std::int64_t k, const SimdMask &is_lost,
              RangeSum &sum)
{
  for (int lane = 0; lane < n_lanes; ++lane)
    if (is_lost[static_cast<std::size_t>(lane)])
      task.surfaces.relocate(task.surfaces.owner, k + lane, &sum);
}

/// Overlap that counts: `overlap_offset` was there when the contact was found,
/// and is given back as the contact opens.
Simd counted_overlap(const Task &task, std::int64_t k, const Simd &overlap)
{
  const Simd depth = stdx::max(overlap, Simd(0.));
  const Simd overlap_offset = load(task.contacts.overlap_offset + k);
  const SimdMask is_given_back =
      overlap_offset > depth && overlap_offset < closed_offset;
  store(select(is_given_back, depth, overlap_offset),
        task.contacts.overlap_offset + k);
  return stdx::max(depth - overlap_offset, Simd(0.));
}

/// Contacts of one set of lanes as they lie, at their common normals.
struct SurfaceGeometry
{
  SimdVector images; ///< of a periodic cell, see images_of()
  SimdVector normal, normal_before;
  SimdVector arm_a, arm_b; ///< from the centres to the contact
  Simd apart;   ///< the surfaces, where the contact is open and known; else 0
  Simd overlap; ///< counted; 0 where open
};

/// Two surfaces before the Newton step.
struct SurfacePair
{
  SimdVector images; ///< of a periodic cell, see images_of()
  SimdVector branch; ///< from the centre of A to the image of B
  SimdSurface on_a, on_b;
  SimdFrame frame;
  SimdShapeOperator shape_operator_a, shape_operator_b;
  LaneStep step;
};

SurfacePair approach_pair(const Task &task, std::int64_t k,
                          const ParticleSimd &a, const ParticleSimd &b)
{
  const Contacts &contacts = task.contacts;
  SurfacePair pair;
  pair.branch = b.vector(at_position) - a.vector(at_position);
  if (task.is_periodic)
  {
    pair.images = images_of(task, pair.branch);
    pair.branch = pair.branch - times(task.cell_length, pair.images);
  }
  pair.on_a = locate_surface(contacts.side_a, k, a);
  pair.on_b = locate_surface(contacts.side_b, k, b);
  pair.frame = across(pair.on_a.normal);
  const SimdVector apart = pair.on_a.arm - pair.branch - pair.on_b.arm;
  pair.shape_operator_a =
      shape_operator_of(contacts.side_a, k, pair.on_a, pair.frame);
  pair.shape_operator_b =
      shape_operator_of(contacts.side_b, k, pair.on_b, pair.frame);
  pair.step = step_to_normal(
      pair.shape_operator_a, pair.shape_operator_b, in_frame(pair.frame, apart),
      in_frame(pair.frame, pair.on_b.normal), dot(apart, pair.on_a.normal));
  pair.step.is_sound = pair.step.is_sound &&
                       is_short(pair.step.on_a, pair.on_a.radius) &&
                       is_short(pair.step.on_b, pair.on_b.radius) &&
                       load(contacts.side_a.radius + k) > 0. &&
                       load(contacts.side_b.radius + k) > 0.;
  return pair;
}

SimdVector normalised(const SimdVector &v)
{
  return 1. / stdx::sqrt(dot(v, v)) * v;
}

/// Follows the pairs to their common normals.
SurfaceGeometry locate_surface_pairs(const Task &task, std::int64_t k,
                                     const ParticleSimd &a,
                                     const ParticleSimd &b,
                                     const SimdMask &is_valid, RangeSum &sum)
{
  const Contacts &contacts = task.contacts;
  const SimdMask is_open = load(contacts.overlap_offset + k) >= closed_offset;
  SurfacePair pair = approach_pair(task, k, a, b);
  const SimdMask is_lost = is_valid && !is_open && !pair.step.is_sound;
  if (any(is_lost))
  {
    relocate(task, k, is_lost, sum);
    pair = approach_pair(task, k, a, b);
  }
  // A contact that ends here gets no step: its old force works where it was.
  const SimdMask is_there = is_valid && pair.step.is_sound;
  const LaneStep step{only(is_there, pair.step.on_a),
                      only(is_there, pair.step.on_b),
                      select(is_there, pair.step.overlap, Simd(0.)), is_there};
  SurfaceGeometry geometry;
  geometry.images = pair.images;
  geometry.apart = stdx::max(-step.overlap, Simd(0.));
  geometry.overlap = counted_overlap(task, k, step.overlap);
  const SimdPlanar turn = pair.shape_operator_a.matrix * step.on_a;
  geometry.normal =
      normalised(pair.on_a.normal + planar_in_world(pair.frame, turn));
  geometry.normal_before =
      pair.on_a.normal -
      cross(Simd(task.time_step) * a.vector(at_spin), pair.on_a.normal);
  geometry.arm_a = pair.on_a.arm + planar_in_world(pair.frame, step.on_a) -
                   0.5 * step.overlap * geometry.normal;
  geometry.arm_b = geometry.arm_a - pair.branch;
  if (!task.adds_loads_only)
  {
    follow_side(task, contacts.side_a, k, 0,
                pair.on_a.radius * pair.on_a.direction +
                    planar_in_body(pair.shape_operator_a, step.on_a),
                is_there);
    follow_side(task, contacts.side_b, k, 1,
                pair.on_b.radius * pair.on_b.direction +
                    planar_in_body(pair.shape_operator_b, step.on_b),
                is_there);
  }
  return geometry;
}

/// Motion of side B against side A of one set of lanes.
ContactMotion<Simd> surface_motion(const Task &task, const ParticleSimd &a,
                                   const ParticleSimd &b,
                                   const SurfaceGeometry &geometry)
{
  const SimdVector spin_a = a.vector(at_spin), spin_b = b.vector(at_spin);
  const SimdQuad moving_a = a.quad(at_velocity), moving_b = b.quad(at_velocity);
  ContactMotion<Simd> motion;
  motion.normal = geometry.normal;
  motion.normal_before = geometry.normal_before;
  motion.velocity = motion.velocity_before =
      moving_b.vector + cross(spin_b, geometry.arm_b) - moving_a.vector -
      cross(spin_a, geometry.arm_a);
  if (task.is_periodic)
    motion.velocity = motion.velocity_before =
        motion.velocity - times(task.cell_rate, geometry.images);
  motion.spin = spin_b - spin_a;
  motion.reduced_mass =
      moving_a.number * moving_b.number / (moving_a.number + moving_b.number);
  const Simd r_a = stdx::sqrt(dot(geometry.arm_a, geometry.arm_a));
  const Simd r_b = stdx::sqrt(dot(geometry.arm_b, geometry.arm_b));
  motion.rolling_radius =
      r_a * r_b / select(geometry.overlap > 0., r_a + r_b, Simd(1.));
  return motion;
}

/// How far particles may move before an open contact point is followed again:
/// so little that it is found from where it was.
Simd until_looked_at(const SurfaceGeometry &pair, const ParticleSimd &a,
                     const ParticleSimd &b)
{
  const Simd radius =
      stdx::min(a.quad(at_position).number, b.quad(at_position).number);
  return stdx::min(0.25 * pair.apart, 0.25 * longest_follow * radius);
}

/// One step of `n_valid` contacts from k.
template <class Law>
[[gnu::flatten]] void advance_surface_pairs(const Task &task, std::int64_t k,
                                            int n_valid, LaneSums &sums,
                                            const Target &target)
{
  const Contacts &contacts = task.contacts;
  const SimdMask is_active = valid_lanes(n_valid) && !inactive(task, k);
  if (!any(is_active))
    return;
  const ParticleSimd a(task.particles.state, contacts.a + k),
      b(task.particles.state, contacts.b + k);
  const SurfaceGeometry pair =
      locate_surface_pairs(task, k, a, b, is_active, target.sum);
  deactivate(task, k, is_active, until_looked_at(pair, a, b));
  const Simd overlap_before = load(contacts.overlap + k);
  if (!any(pair.overlap > 0. || overlap_before > 0.))
    return; // all is zero and stays so
  ContactHistory<Simd> history = load_history<Law>(task, k, overlap_before);
  const Simd energy_before = history.normal_energy;
  SimdVector force;
  if (task.adds_loads_only)
    force = kept_force(history, pair.normal);
  else
  {
    const ContactMotion<Simd> motion = surface_motion(task, a, b, pair);
    refresh_prefactors(task, k, pair.normal, pair.overlap > 0.,
                       dot(motion.spin, pair.normal));
    force = advance_law<Law>(task, motion, pair.overlap, overlap_before,
                             mixed_spring<Law>(task, k, pair.overlap), history,
                             sums);
    store_history<Law>(history, contacts, k);
    store(pair.overlap, contacts.overlap + k);
  }
  const PairLoad load(task, force, cross(pair.arm_a, force) + history.rolling,
                      -cross(pair.arm_b, force) - history.rolling);
  scatter_pairs(task, k, n_valid, load, target);
  sums.note(load.force);
  if (task.is_periodic)
    add_cell_force(pair.images, load.force, n_valid, target.sum);
  if (task.has_damage)
    find_damage(task, k, {pair.overlap, energy_before, history.normal_energy},
                target.sum);
}

/// A surface before a wall, before the Newton step.
struct SurfaceAtWall
{
  SimdSurface on_a;
  SimdFrame frame;
  SimdShapeOperator shape_operator;
  SimdPlanar step;
  Simd overlap; ///< after the step; < 0: a gap
  SimdMask is_sound;
};

/// The support point: K_A a = -m with m the part of n_A across the wall's
/// normal n.
SurfaceAtWall approach_wall(const Task &task, std::int64_t k,
                            const ParticleSimd &a, const WallSimd &wall)
{
  const Side &side = task.contacts.side_a;
  const SimdVector normal = wall.vector(at_normal);
  SurfaceAtWall at;
  at.on_a = locate_surface(side, k, a);
  at.frame = across(normal);
  at.shape_operator = shape_operator_of(side, k, at.on_a, at.frame);
  const SimdPlanar m = in_frame(at.frame, at.on_a.normal);
  const SimdMatrix &shape_operator = at.shape_operator.matrix;
  const Simd determinant = shape_operator.determinant();
  at.is_sound = shape_operator.xx > 0. && determinant > 0. &&
                load(side.radius + k) > 0. && dot(at.on_a.normal, normal) > 0.;
  const Simd inverse = 1. / select(at.is_sound, determinant, Simd(1.));
  at.step = {inverse * (shape_operator.xy * m.y - shape_operator.yy * m.x),
             inverse * (shape_operator.xy * m.x - shape_operator.xx * m.y)};
  at.is_sound = at.is_sound && is_short(at.step, at.on_a.radius);
  at.overlap =
      dot(a.vector(at_position) + at.on_a.arm - wall.vector(at_point), normal) -
      0.5 * dot(m, at.step);
  return at;
}

/// Contacts of one set of lanes with walls, at their support points.
struct SupportGeometry
{
  SimdVector arm; ///< from the centre to the contact
  Simd overlap;   ///< counted; 0 where open
};

SupportGeometry locate_support(const Task &task, std::int64_t k,
                               const ParticleSimd &a, const WallSimd &wall,
                               const SimdMask &is_valid, RangeSum &sum)
{
  const SimdVector normal = wall.vector(at_normal);
  const SimdMask is_open =
      load(task.contacts.overlap_offset + k) >= closed_offset;
  SurfaceAtWall at = approach_wall(task, k, a, wall);
  const SimdQuad sphere = a.quad(at_position);
  const Simd distance = dot(wall.vector(at_point) - sphere.vector, normal);
  const SimdMask is_near =
      is_valid && !is_open && distance < far_wall * sphere.number;
  const SimdMask is_lost = is_near && !at.is_sound;
  if (any(is_lost))
  {
    relocate(task, k, is_lost, sum);
    at = approach_wall(task, k, a, wall);
  }
  const SimdMask is_there = is_near && at.is_sound;
  at.step = only(is_there, at.step);
  at.overlap = select(is_there, at.overlap, Simd(0.));
  SupportGeometry geometry;
  geometry.overlap = counted_overlap(task, k, at.overlap);
  const SimdVector aside = at.on_a.arm + planar_in_world(at.frame, at.step);
  // On the normal the contact is half way into the wall.
  geometry.arm =
      aside + (distance + 0.5 * at.overlap - dot(aside, normal)) * normal;
  if (!task.adds_loads_only)
    follow_side(task, task.contacts.side_a, k, 0,
                at.on_a.radius * at.on_a.direction +
                    planar_in_body(at.shape_operator, at.step),
                is_there);
  return geometry;
}

/// Motion of the walls against the particles of one set of lanes.
ContactMotion<Simd> support_motion(const ParticleSimd &a, const WallSimd &wall,
                                   const SupportGeometry &geometry)
{
  const SimdVector spin = a.vector(at_spin);
  const SimdQuad moving = a.quad(at_velocity);
  const SimdVector own = moving.vector + cross(spin, geometry.arm);
  ContactMotion<Simd> motion;
  motion.normal = wall.vector(at_normal);
  const SimdQuad before = wall.quad(at_normal_before);
  motion.normal_before = before.vector;
  motion.velocity = wall.vector(at_wall_velocity) - own;
  motion.velocity_before = wall.vector(at_velocity_before) - own;
  motion.spin = -spin;
  motion.reduced_mass = moving.number / (1. + moving.number * before.number);
  motion.rolling_radius = stdx::sqrt(dot(geometry.arm, geometry.arm));
  return motion;
}

/// Forces and loads of contacts with walls whose contact points are known.
template <class Law>
void advance_at_wall(const Task &task, std::int64_t k, int n_valid,
                     const ParticleSimd &a, const WallSimd &wall,
                     const SupportGeometry &geometry, LaneSums &sums,
                     const Target &target)
{
  const Contacts &contacts = task.contacts;
  if (!any_loaded(task, k, geometry.overlap))
    return;
  const Simd overlap_before = load(contacts.overlap + k);
  ContactHistory<Simd> history = load_history<Law>(task, k, overlap_before);
  const Simd energy_before = history.normal_energy;
  SimdVector force;
  if (task.adds_loads_only)
    force = kept_force(history, wall.vector(at_normal));
  else
  {
    const ContactMotion<Simd> motion = support_motion(a, wall, geometry);
    force = advance_law<Law>(
        task, motion, geometry.overlap, overlap_before,
        wall_spring<Law>(task, k, motion.rolling_radius, geometry.overlap),
        history, sums);
    store_history<Law>(history, contacts, k);
    store(geometry.overlap, contacts.overlap + k);
  }
  sums.note(force);
  scatter_walls(task, k, n_valid, force,
                cross(geometry.arm, force) + history.rolling, target);
  if (task.has_damage)
    find_damage(task, k,
                {geometry.overlap, energy_before, history.normal_energy},
                target.sum);
}

template <class Law>
[[gnu::flatten]] void advance_surface_walls(const Task &task, std::int64_t k,
                                            int n_valid, LaneSums &sums,
                                            const Target &target)
{
  const ParticleSimd a(task.particles.state, task.contacts.a + k);
  const WallSimd wall(task.walls, task.contacts.b + k);
  advance_at_wall<Law>(
      task, k, n_valid, a, wall,
      locate_support(task, k, a, wall, valid_lanes(n_valid), target.sum), sums,
      target);
}
} // namespace
} // namespace dem::kernel
