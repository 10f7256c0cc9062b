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
  SimdMask is_sound; ///< a maximum of the overlap, and the step is short
};

/// Solves (K_A + K_B - delta K_B K_A) a = -m - K_B t, as newton_step() does.
LaneStep step_to_normal(const SimdMatrix &ka, const SimdMatrix &kb,
                        const SimdPlanar &t, const SimdPlanar &m,
                        const Simd &overlap)
{
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
  step.is_sound = lens.xx + lens.yy > 0. && determinant > 0.;
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

/// Notes where the contact is now, and renews the surface where that is too far
/// from where it was evaluated.
void follow_side(const Task &task, const Side &side, std::int64_t k, int which,
                 const SimdSurface &before, const SimdPlanar &step,
                 const SimdMask &is_followed)
{
  const SimdMask is_stale = move_on_surface(side, k, before, step, is_followed,
                                            task.refresh_tolerance);
  if (!any(is_stale))
    return;
  for (int lane = 0; lane < n_lanes; ++lane)
    if (is_stale[static_cast<std::size_t>(lane)])
      task.surfaces.renew(task.surfaces.owner, k + lane, which, nullptr);
}

/// Has the contacts of some lanes searched again, one by one. Returns how far
/// their surfaces are apart, < 0 where they overlap; 0 where there is no
/// contact point.
Simd relocate(const Task &task, std::int64_t k, const SimdMask &is_lost,
              RangeSum &sum)
{
  Simd apart(0.);
  for (int lane = 0; lane < n_lanes; ++lane)
    if (const auto l = static_cast<std::size_t>(lane); is_lost[l])
      apart[l] = task.surfaces.relocate(task.surfaces.owner, k + lane, &sum);
  return apart;
}

/// Overlap that counts: `overlap_offset` was there when the contact was found,
/// and is given back as the contact opens. Pairs that are not seen keep it, and
/// those that overlap without a lens go on from the depth that they have then.
Simd counted_overlap(const Task &task, std::int64_t k, const Simd &overlap,
                     const SimdMask &is_seen = SimdMask(true),
                     const SimdMask &has_no_lens = SimdMask(false))
{
  const Simd depth = stdx::max(overlap, Simd(0.));
  const Simd overlap_offset = load(task.contacts.overlap_offset + k);
  const SimdMask is_set = is_seen && overlap_offset < closed_offset &&
                          (has_no_lens || overlap_offset > depth);
  store(select(is_set, depth, overlap_offset),
        task.contacts.overlap_offset + k);
  return select(has_no_lens, Simd(0.),
                stdx::max(depth - overlap_offset, Simd(0.)));
}

/// Contacts of one set of lanes as they lie, at their common normals.
struct SurfaceGeometry
{
  SimdVector images; ///< of a periodic cell, see images_of()
  SimdVector normal, normal_before;
  SimdVector arm_a, arm_b; ///< from the centres to the contact
  Simd apart; ///< the surfaces, where the contact is open and known; else 0
  SimdMask has_no_lens; ///< overlaps where the normals face each other, no more
  Simd overlap;         ///< counted; 0 where open
};

/// Changes between the frames of two surfaces that face each other: a
/// reflection, its own inverse, but for the square of the angle between them.
struct OpposedFrames
{
  Simd cosine, sine;

  OpposedFrames() = default;
  OpposedFrames(const SimdFrame &a, const SimdFrame &b)
      : cosine(dot(a.first, b.first)), sine(dot(a.first, b.second))
  {
  }
  SimdPlanar operator*(const SimdPlanar &v) const
  {
    return {cosine * v.x + sine * v.y, sine * v.x - cosine * v.y};
  }
  SimdMatrix operator*(const SimdMatrix &m) const
  {
    const Simd cc = cosine * cosine, ss = sine * sine, cs = cosine * sine,
               mixed = 2. * cs * m.xy;
    return {cc * m.xx + mixed + ss * m.yy,
            cs * (m.xx - m.yy) + (ss - cc) * m.xy,
            ss * m.xx - mixed + cc * m.yy};
  }
};

/// Two surfaces before the Newton step.
struct SurfacePair
{
  SimdVector images; ///< of a periodic cell, see images_of()
  SimdVector branch; ///< from the centre of A to the image of B
  SimdSurface on_a, on_b;
  SimdVector normal;    ///< of A
  OpposedFrames from_b; ///< from the frame of B to that of A and back
  LaneStep step;        ///< in the frame of A
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
  const SimdSurface &a_side = pair.on_a, &b_side = pair.on_b;
  const SimdVector apart = a_side.arm - pair.branch - b_side.arm;
  const SimdVector facing = b_side.outward();
  const SimdPlanar aside = in_frame(a_side.frame, apart),
                   tilt = in_frame(a_side.frame, facing);
  const Simd depth = dot(a_side.axis, apart),
             against = dot(a_side.axis, facing);
  const Simd inverse_length = a_side.inverse_length();
  pair.normal = inverse_length * a_side.outward();
  pair.from_b = OpposedFrames(a_side.frame, b_side.frame);
  pair.step =
      step_to_normal(a_side.shape_operator, pair.from_b * b_side.shape_operator,
                     a_side.across(aside, depth), a_side.across(tilt, against),
                     inverse_length * a_side.along(aside, depth));
  pair.step.is_sound = pair.step.is_sound && against < 0. &&
                       is_short(pair.step.on_a, a_side.height) &&
                       is_short(pair.step.on_b, b_side.height);
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
  Simd found_apart(0.);
  if (any(is_lost))
  {
    found_apart = relocate(task, k, is_lost, sum);
    pair = approach_pair(task, k, a, b);
  }
  // A contact that ends here gets no step: its old force works where it was.
  const SimdMask is_there = is_valid && pair.step.is_sound;
  const LaneStep step{only(is_there, pair.step.on_a),
                      only(is_there, pair.step.on_b),
                      select(is_there, pair.step.overlap, Simd(0.)), is_there};
  SurfaceGeometry geometry;
  geometry.images = pair.images;
  // Between surfaces that are nearly flat the step may not hold where the
  // search has just found the contact point: open ones rest all the same.
  geometry.apart =
      stdx::max(select(is_there, -step.overlap, found_apart), Simd(0.));
  geometry.has_no_lens = is_lost && !is_there && found_apart < 0.;
  geometry.overlap = counted_overlap(
      task, k, select(geometry.has_no_lens, -found_apart, step.overlap),
      is_valid, geometry.has_no_lens);
  const SimdPlanar turn = pair.on_a.shape_operator * step.on_a;
  geometry.normal = normalised(pair.normal + pair.on_a.frame.in_world(turn));
  geometry.normal_before =
      pair.normal -
      cross(Simd(task.time_step) * a.vector(at_spin), pair.normal);
  geometry.arm_a = pair.on_a.arm + pair.on_a.frame.in_world(step.on_a) -
                   0.5 * step.overlap * geometry.normal;
  geometry.arm_b = geometry.arm_a - pair.branch;
  if (!task.adds_loads_only)
  {
    follow_side(task, contacts.side_a, k, 0, pair.on_a, step.on_a, is_there);
    follow_side(task, contacts.side_b, k, 1, pair.on_b, pair.from_b * step.on_b,
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
/// so little that it is found from where it was. One that overlaps without a
/// lens carries nothing, and gets none before its particles move.
Simd until_looked_at(const SurfaceGeometry &pair, const ParticleSimd &a,
                     const ParticleSimd &b)
{
  const Simd radius =
      stdx::min(a.quad(at_position).number, b.quad(at_position).number);
  constexpr double without_lens = 1e-4; // of the radius
  return select(pair.has_no_lens, without_lens * radius,
                stdx::min(0.25 * pair.apart, 0.25 * longest_follow * radius));
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
  const Simd facing = dot(at.on_a.axis, normal);
  const SimdPlanar back =
      at.on_a.across(in_frame(at.on_a.frame, normal), facing);
  const SimdPlanar m{-back.x, -back.y};
  const SimdMatrix &shape_operator = at.on_a.shape_operator;
  const Simd determinant = shape_operator.determinant();
  at.is_sound = shape_operator.xx > 0. && determinant > 0. && facing > 0.;
  const Simd inverse = 1. / select(at.is_sound, determinant, Simd(1.));
  at.step = {inverse * (shape_operator.xy * m.y - shape_operator.yy * m.x),
             inverse * (shape_operator.xy * m.x - shape_operator.xx * m.y)};
  at.is_sound = at.is_sound && is_short(at.step, at.on_a.height);
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
  const SimdVector aside = at.on_a.arm + at.on_a.frame.in_world(at.step);
  // On the normal the contact is half way into the wall.
  geometry.arm =
      aside + (distance + 0.5 * at.overlap - dot(aside, normal)) * normal;
  if (!task.adds_loads_only)
    follow_side(task, task.contacts.side_a, k, 0, at.on_a, at.step, is_there);
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
