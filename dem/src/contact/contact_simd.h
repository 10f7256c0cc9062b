#pragma once

#include "particle_simd.h"

#include <dem/contact/damage.h>
#include <dem/contact/rounding.h>

/// What contacts with particles and with walls have in common, in lanes.
/// Internal to the units that are compiled once per instruction set.
namespace dem::kernel
{
namespace
{
/// Direction of one side of a block of contacts in the frame of its particle.
SimdVector side_direction(const ParticleSimd &particle, const SimdVector &world)
{
  return to_body(particle.quad(at_orientation), world);
}

/// Renews the sides that no longer hold for `direction`.
void refresh_side(const Task &task, const Side &side, std::int64_t k, int which,
                  const SimdVector &direction, const SimdMask &is_looked_at)
{
  const SimdVector away = direction - load_vector(side.direction, k);
  const SimdMask is_stale =
      is_looked_at &&
      dot(away, away) > task.refresh_tolerance * task.refresh_tolerance;
  if (!any(is_stale))
    return;
  SimdTable<4> table;
  table.set(0, {direction});
  for (int lane = 0; lane < n_lanes; ++lane)
    if (is_stale[static_cast<std::size_t>(lane)])
      task.surfaces.renew(task.surfaces.owner, k + lane, which,
                          table.value[lane]);
}

/// r at `direction` from the expansions: r + g.w + w.H.w / 2.
Simd expanded_radius(const Side &side, std::int64_t k,
                     const SimdVector &direction)
{
  const SimdVector w = direction - load_vector(side.direction, k);
  const SimdVector gradient = load_vector(side.gradient, k);
  const Simd diagonal = load(side.hessian[0] + k) * w.x * w.x +
                        load(side.hessian[1] + k) * w.y * w.y +
                        load(side.hessian[2] + k) * w.z * w.z;
  const Simd mixed = load(side.hessian[3] + k) * w.x * w.y +
                     load(side.hessian[4] + k) * w.x * w.z +
                     load(side.hessian[5] + k) * w.y * w.z;
  return load(side.radius + k) + dot(gradient, w) + 0.5 * diagonal + mixed;
}

/// What the contacts of a range add up to, lane by lane.
struct LaneSums
{
  Losses<Simd> lost, lost_rest; ///< see loss_spacing
  Simd largest_force = 0.;      ///< component, without its sign

  void add(const Losses<Simd> &losses)
  {
    add(losses.friction, lost.friction, lost_rest.friction);
    add(losses.rolling, lost.rolling, lost_rest.rolling);
    add(losses.damping, lost.damping, lost_rest.damping);
    add(losses.non_conservative_work, lost.non_conservative_work,
        lost_rest.non_conservative_work);
  }
  void note(const SimdVector &force)
  {
    largest_force =
        stdx::max(stdx::max(largest_force, stdx::abs(force.x)),
                  stdx::max(stdx::abs(force.y), stdx::abs(force.z)));
  }

private:
  static void add(const Simd &loss, Simd &sum, Simd &rest)
  {
    const Simd first = on_grid(loss, rounding_shift(loss_spacing));
    sum += first;
    rest += on_grid(loss - first, rounding_shift(loss_rest_spacing));
  }
};

/// Springs of contacts whose overlaps were these.
template <class Law>
ContactHistory<Simd> load_history(const Task &task, std::int64_t k,
                                  const Simd &overlap_before)
{
  const Contacts &contacts = task.contacts;
  ContactHistory<Simd> history;
  history.shear = load_vector(contacts.shear, k);
  if (contacts.rolling.x)
  {
    history.rolling = load_vector(contacts.rolling, k);
    history.rolling_compliance = load(contacts.rolling_compliance + k);
  }
  history.dashpot = load_vector(contacts.dashpot, k);
  history.shear_compliance = load(contacts.shear_compliance + k);
  history.normal_force = load(contacts.normal_force + k);
  if constexpr (Law::attracts)
  {
    history.normal_energy = load(contacts.normal_energy + k);
    history.attraction = load(contacts.attraction + k);
  }
  else
    history.normal_energy =
        Law::energy(task.law, history.normal_force, overlap_before);
  return history;
}

/// Energy of what presses: the criterion of breakage ignores attraction.
template <class Law>
Simd elastic_energy(const Task &task, const ContactHistory<Simd> &history,
                    const Simd &overlap)
{
  if constexpr (Law::attracts)
    return Law::energy(task.law, history.normal_force + history.attraction,
                       overlap);
  else
    return history.normal_energy;
}

/// Whether some contacts have a force, or had one in the last step. `reach`:
/// how far they are within the range of the law, > 0.
template <class Law>
bool any_alive(const Task &task, std::int64_t k, const Simd &reach,
               const Simd &overlap_before)
{
  if constexpr (Law::attracts)
    return any(reach > 0. || overlap_before > 0. ||
               load(task.contacts.attraction + k) > 0.);
  // A linear contact that has just ended may pull still (cut_at_crossing).
  else
    return any(reach > 0. || overlap_before > 0.) ||
           any(load(task.contacts.normal_force + k) != 0.);
}

/// Force on A as the last step left it.
SimdVector kept_force(const ContactHistory<Simd> &history,
                      const SimdVector &normal)
{
  return history.shear + history.dashpot - history.normal_force * normal;
}

template <class Law>
void store_history(const ContactHistory<Simd> &history,
                   const Contacts &contacts, std::int64_t k)
{
  if constexpr (Law::attracts)
  {
    store(history.normal_energy, contacts.normal_energy + k);
    store(history.attraction, contacts.attraction + k);
  }
  store_vector(history.shear, contacts.shear, k);
  if (contacts.rolling.x)
  {
    store_vector(history.rolling, contacts.rolling, k);
    store(history.rolling_compliance, contacts.rolling_compliance + k);
  }
  store_vector(history.dashpot, contacts.dashpot, k);
  store(history.shear_compliance, contacts.shear_compliance + k);
  store(history.normal_force, contacts.normal_force + k);
}

/// Takes from springs of a constant stiffness what they give too much where a
/// contact begins or ends within the step: its last normal force is taken back
/// by a pull, its first shear force is that of the way since it began.
template <class Law>
void cut_at_crossing(const Task &task, const ContactMotion<Simd> &motion,
                     const Simd &overlap, const Simd &overlap_before,
                     const ContactHistory<Simd> &history,
                     NormalSpring<Simd> &spring)
{
  const SimdMask begins = overlap > 0. && overlap_before <= 0.,
                 ends = overlap_before > 0. && overlap <= 0.;
  if (!any(begins || ends))
    return;
  const double dt = task.time_step;
  const double normal_stiffness =
      Law::template spring<double>(task.law, {}, 1.).stiffness;
  const Simd stiffness = normal_stiffness * dt * dt / motion.reduced_mass;
  const Simd closed = -dt * dot(motion.velocity, motion.normal);
  spring.first_share =
      select(begins, overlap / stdx::max(overlap, closed), Simd(1.));
  const Simd opened = dt * dot(motion.velocity_before, motion.normal_before);
  const Simd pressing =
      history.normal_force - dot(history.dashpot, motion.normal_before);
  spring.force -=
      select(begins,
             spring.force * part_before_begin<Simd>(
                                {overlap, closed - overlap, stiffness}),
             Simd(0.)) +
      select(ends,
             pressing *
                 part_after_end<Simd>(
                     {overlap_before, opened - overlap_before, stiffness}),
             Simd(0.));
}

/// One step of the law; the springs go into `history`. Returns the force on A.
template <class Law>
SimdVector advance_law(const Task &task, const ContactMotion<Simd> &motion,
                       const Simd &overlap, const Simd &overlap_before,
                       NormalSpring<Simd> spring, ContactHistory<Simd> &history,
                       LaneSums &sums)
{
  if constexpr (!Law::scales_with_curvature && !Law::attracts &&
                Law::exponent == 1.)
    cut_at_crossing<Law>(task, motion, overlap, overlap_before, history,
                         spring);
  Losses<Simd> in_step;
  const SimdVector force = advance_contact<Law>(
      motion, spring, task.coefficients, task.time_step, history, in_step);
  sums.add(in_step);
  return force;
}

/// Spring of two equivalent spheres or of one on a plate, from R.
template <class Law>
NormalSpring<Simd> sphere_spring(const Task &task, const Simd &radius,
                                 const Simd &overlap)
{
  if constexpr (Law::scales_with_curvature)
  {
    const Simd root = stdx::sqrt(radius);
    return Law::spring(task.law,
                       Prefactors<Simd>{Simd(task.normal_factor * root),
                                        Simd(task.shear_factor * root), radius},
                       overlap);
  }
  else
    return Law::spring(task.law, Prefactors<Simd>{}, overlap);
}

/// Spring of surfaces whose prefactors are in the columns.
template <class Law>
NormalSpring<Simd> mixed_spring(const Task &task, std::int64_t k,
                                const Simd &overlap)
{
  if constexpr (!Law::scales_with_curvature)
    return Law::spring(task.law, Prefactors<Simd>{}, overlap);
  else
  {
    Prefactors<Simd> of{load(task.contacts.normal_prefactor + k),
                        load(task.contacts.shear_prefactor + k)};
    if constexpr (Law::attracts)
      of.radius = load(task.contacts.reduced_radius + k);
    return Law::spring(task.law, of, overlap);
  }
}

/// Where the load of a contact on its side A goes: to the particle, or to the
/// sum of the range for the first particle of it.
struct Target
{
  std::int32_t first;
  RangeSum &sum;

  double *row(const Task &task, std::int32_t particle) const
  {
    return particle == first
               ? sum.load
               : task.particles.load +
                     load_row * static_cast<std::int64_t>(particle);
  }
};

/// Where the load on side B goes: to the particle, or to a row of the halo.
double *partner_load(const Task &task, std::int32_t target)
{
  const std::int64_t row = target;
  return row >= 0 ? task.particles.load + load_row * row
                  : task.particles.halo + load_row * (-1 - row);
}

/// Adds force and moment to a row: the first four numbers and the other two.
void add_load(const double *four, const double *two, double *row)
{
  store_pack(load_pack<4>(row) + load_pack<4>(four), row);
  store_pack(load_pack<2>(row + 4) + load_pack<2>(two), row + 4);
}

/// Overlap and elastic energy of a set of lanes, now and in the last step.
struct Loading
{
  Simd overlap, energy_before, energy;
};

/// What the criterion compares.
struct Damage
{
  Simd overlap, rise, energy;
  SimdMask ends; ///< contacts that open and lose their factors
};

/// Eqs. 4 and 5 for one side of the contacts. Most are no corner or are not
/// loaded further: their factors are not even read. `bit` names the side in
/// the events.
void damage_side(const Task &task, std::int64_t k, const Damage &damage,
                 const Narrow *corner, double *factor, unsigned bit,
                 RangeSum &sum)
{
  const Simd fracture_energy =
      task.fracture_energy * load(corner + k) * damage.overlap;
  const SimdMask is_loaded =
      fracture_energy > 0. &&
      (damage.rise > 0. || damage.energy > fracture_energy);
  if (!any(is_loaded || damage.ends))
    return;
  const Simd old = load(factor + k);
  const DamageStep<Simd> step =
      damage_step(old, damage.rise, damage.energy,
                  select(is_loaded, fracture_energy, Simd(1.)));
  const SimdMask grows = is_loaded && SimdMask(task.repetitions > 0.);
  store(select(grows, step.factor, select(damage.ends, Simd(0.), old)),
        factor + k);
  const SimdMask breaks = grows && (step.factor > 1. || step.energy_ratio > 1.);
  if (!any(breaks))
    return;
  sum.wants_breakage = true;
  for (int lane = 0; lane < n_lanes; ++lane)
    if (breaks[static_cast<std::size_t>(lane)])
    {
      std::uint8_t &event = task.contacts.event[k + lane];
      event = static_cast<std::uint8_t>(event | bit);
    }
}

/// With the energy of the shear spring, and cycles that do not count left out.
void count_turns(const Task &task, std::int64_t k, Damage &damage)
{
  const Contacts &contacts = task.contacts;
  if (task.counts_shear)
  {
    const SimdVector shear = load_vector(contacts.shear, k);
    damage.energy +=
        0.5 * dot(shear, shear) * load(contacts.shear_compliance + k);
  }
  const Simd before = load(contacts.reversal + k);
  store(reversal_of_energy(before, damage.energy, task.hysteresis),
        contacts.reversal + k);
  damage.rise = counted_rise(before, load(contacts.reversal + k));
}

/// Rises beyond the peak count many times.
void repeat_peaks(const Task &task, std::int64_t k, Damage &damage)
{
  const Simd peak = load(task.contacts.peak + k);
  const Simd fresh = damage.energy - max(peak, damage.energy - damage.rise);
  damage.rise += (task.repetitions - 1.) * max(Simd(0.), fresh);
  store(max(peak, damage.energy), task.contacts.peak + k);
}

/// Marks the contacts that begin or end.
void mark_switched(const Task &task, std::int64_t k, const Loading &last,
                   RangeSum &sum)
{
  const SimdMask has_switched =
      (last.overlap > 0.) != (last.energy_before > 0.);
  if (!any(has_switched))
    return;
  sum.has_switched = true;
  for (int lane = 0; lane < n_lanes; ++lane)
    if (has_switched[static_cast<std::size_t>(lane)])
    {
      std::uint8_t &event = task.contacts.event[k + lane];
      event = static_cast<std::uint8_t>(event | 4u);
    }
}

void find_damage(const Task &task, std::int64_t k, const Loading &last,
                 RangeSum &sum)
{
  const Contacts &contacts = task.contacts;
  if (task.keeps_factors)
    mark_switched(task, k, last, sum);
  Damage damage{last.overlap, last.energy - last.energy_before, last.energy,
                SimdMask(!task.keeps_factors) && last.overlap <= 0. &&
                    last.energy_before > 0.};
  if (contacts.reversal)
    count_turns(task, k, damage);
  if (contacts.peak)
    repeat_peaks(task, k, damage);
  damage_side(task, k, damage, contacts.corner_a, contacts.factor_a, 1u, sum);
  if (contacts.corner_b)
    damage_side(task, k, damage, contacts.corner_b, contacts.factor_b, 2u, sum);
}
} // namespace
} // namespace dem::kernel
