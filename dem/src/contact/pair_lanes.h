#pragma once

#include "contact_lanes.h"

/// Stone against stone, in lanes.
namespace dem::kernel
{
namespace
{
/// How far the stones of each pair have travelled, both together.
Lanes travel_of_pairs(const Task &task, std::int64_t k)
{
  const double *travelled = task.stones.travelled;
  if (!travelled)
    return Lanes(task.stones.gaps_travelled);
  const std::int32_t *a = task.contacts.a + k, *b = task.contacts.b + k;
  return Lanes([=](auto lane)
               { return travelled[a[lane]] + travelled[b[lane]]; });
}

/// Contacts that cannot touch yet. Nothing of them changes, whatever the lanes
/// beside them do.
LaneMask asleep(const Task &task, std::int64_t k)
{
  const Lanes wake = load(task.contacts.wake + k);
  const LaneMask sleeps = wake > 0.;
  return any(sleeps) ? sleeps && travel_of_pairs(task, k) < wake : sleeps;
}

/// Lets those that are awake, and apart by more than 0, sleep until their
/// stones have travelled so far.
void fall_asleep(const Task &task, std::int64_t k, const LaneMask &is_awake,
                 const Lanes &apart)
{
  const Lanes wake = load(task.contacts.wake + k);
  const LaneMask is_open = is_awake && apart > 0.;
  if (any(is_open || (is_awake && wake > 0.)))
    store(select(is_awake,
                 select(is_open, travel_of_pairs(task, k) + apart, Lanes(0.)),
                 wake),
          task.contacts.wake + k);
}

/// Contacts of one set of lanes as they lie.
struct PairGeometry
{
  LaneVector normal;
  Lanes inverse_distance;   ///< of the centres; 0 where they coincide
  Lanes radius_a, radius_b; ///< towards each other
  Lanes gap;                ///< < 0: an overlap
  Lanes overlap;            ///< 0 where open

  /// From the centres to the middle of the overlap.
  Lanes arm_a() const { return radius_a - 0.5 * overlap; }
  Lanes arm_b() const { return radius_b - 0.5 * overlap; }
};

PairGeometry locate_pairs(const Task &task, std::int64_t k, const StoneLanes &a,
                          const StoneLanes &b, const LaneMask &is_awake)
{
  const LaneQuad ball_a = a.quad(at_position), ball_b = b.quad(at_position);
  const LaneVector branch = ball_b.vector - ball_a.vector;
  const Lanes square = dot(branch, branch);
  // Entries that only fill the last block lie on themselves.
  const LaneMask is_apart = square > 0.;
  const Lanes distance = stdx::sqrt(square);
  PairGeometry pair;
  pair.inverse_distance =
      select(is_apart, 1. / select(is_apart, distance, Lanes(1.)), Lanes(0.));
  pair.normal = pair.inverse_distance * branch;
  if (task.reads_surface)
  {
    const LaneVector on_a = side_direction(a, pair.normal);
    const LaneVector on_b = side_direction(b, -pair.normal);
    const LaneMask is_looked_at = is_apart && is_awake;
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
  const Lanes depth = pair.radius_a + pair.radius_b - distance;
  pair.gap = -depth;
  pair.overlap =
      select(is_apart && is_awake, stdx::max(depth, Lanes(0.)), Lanes(0.));
  return pair;
}

/// Mixes the prefactors anew where the stones have turned about the normal.
void refresh_prefactors(const Task &task, std::int64_t k,
                        const PairGeometry &pair, const Lanes &spin)
{
  const Contacts &contacts = task.contacts;
  const LaneMask is_touching = pair.overlap > 0.;
  const Lanes twist =
      load(contacts.twist + k) +
      select(is_touching, stdx::abs(spin) * task.time_step, Lanes(0.));
  store(twist, contacts.twist + k);
  const LaneMask is_old = is_touching && twist > task.refresh_tolerance;
  if (!any(is_old))
    return;
  LaneTable<4> table;
  table.set(0, {pair.normal});
  for (int lane = 0; lane < n_lanes; ++lane)
    if (is_old[static_cast<std::size_t>(lane)])
      task.surfaces.mix(task.surfaces.owner, k + lane, table.value[lane]);
}

/// Loads on stones A and B: forces, then moments.
struct PairLoad
{
  LaneVector force_a, moment_a, force_b, moment_b;
};

void scatter_pairs(const Task &task, std::int64_t k, int n_valid,
                   const PairLoad &load, const Target &target)
{
  // What is read in one piece was written in one: it need not wait for memory.
  LaneTable<12> table;
  table.set(0, {load.force_a, load.moment_a.x});
  table.set(4, {load.force_b, load.moment_b.x});
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
ContactMotion<Lanes> pair_motion(const Task &task, const StoneLanes &a,
                                 const StoneLanes &b, const PairGeometry &pair)
{
  const LaneVector spin_a = a.vector(at_spin), spin_b = b.vector(at_spin);
  const LaneQuad moving_a = a.quad(at_velocity), moving_b = b.quad(at_velocity);
  const LaneVector parting = moving_b.vector - moving_a.vector;
  ContactMotion<Lanes> motion;
  motion.normal = pair.normal;
  // The centres have parted along straight lines in this step.
  motion.normal_before =
      pair.normal - pair.inverse_distance * Lanes(task.time_step) *
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

/// The normal spring: prefactors of the surfaces, or of two balls.
NormalSpring<Lanes> pair_spring(const Task &task, std::int64_t k,
                                const PairGeometry &pair,
                                const ContactMotion<Lanes> &motion)
{
  if (task.reads_surface)
  {
    refresh_prefactors(task, k, pair, dot(motion.spin, pair.normal));
    return hertz_spring(load(task.contacts.normal_prefactor + k),
                        load(task.contacts.shear_prefactor + k), pair.overlap);
  }
  // Entries that only fill the last block know no radius.
  const Lanes radius =
      pair.radius_a * pair.radius_b /
      select(pair.overlap > 0., pair.radius_a + pair.radius_b, Lanes(1.));
  const Lanes root = stdx::sqrt(radius);
  return hertz_spring(Lanes(task.normal_factor * root),
                      Lanes(task.shear_factor * root), pair.overlap);
}

/// One step of `n_valid` contacts from k.
[[gnu::flatten]] void advance_pairs(const Task &task, std::int64_t k,
                                    int n_valid, Losses<Lanes> &lost,
                                    const Target &target)
{
  const Contacts &contacts = task.contacts;
  const LaneMask is_awake = !asleep(task, k);
  if (!any(is_awake))
    return;
  const StoneLanes a(task.stones.state, contacts.a + k),
      b(task.stones.state, contacts.b + k);
  const PairGeometry pair = locate_pairs(task, k, a, b, is_awake);
  fall_asleep(task, k, is_awake, pair.gap);
  const Lanes overlap_before = load(contacts.overlap + k);
  if (!any(pair.overlap > 0. || overlap_before > 0.))
    return; // all is zero and stays so
  ContactHistory<Lanes> history = load_history(contacts, k, overlap_before);
  const Lanes energy_before = history.normal_energy;
  LaneVector force;
  if (task.adds_loads_only)
    force = kept_force(history, pair.normal);
  else
  {
    const ContactMotion<Lanes> motion = pair_motion(task, a, b, pair);
    force = advance_contact(motion, pair_spring(task, k, pair, motion),
                            task.coefficients, task.time_step, history, lost);
    store_history(history, contacts, k);
    store(pair.overlap, contacts.overlap + k);
  }
  const LaneVector turning = cross(pair.normal, force);
  scatter_pairs(task, k, n_valid,
                {force, pair.arm_a() * turning + history.rolling, -force,
                 pair.arm_b() * turning - history.rolling},
                target);
  if (task.has_damage)
    find_damage(task, k, {pair.overlap, energy_before, history.normal_energy},
                target.sum);
}
} // namespace
} // namespace dem::kernel
