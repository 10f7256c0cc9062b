#pragma once

#include "force_kernels.h"
#include "lane_rows.h"

#include <dem/breakage/criterion.h>

/// What contacts with stones and with walls have in common, in lanes. Internal
/// to the units that are compiled once per instruction set.
namespace dem::kernel
{
namespace
{
using StoneLanes = LaneRows<stone_row>;

/// Lanes that are contacts; the others only fill the set.
LaneMask valid_lanes(int n_valid)
{
  const Lanes place([](auto lane) { return static_cast<double>(lane); });
  return place < static_cast<double>(n_valid);
}

/// Direction of one side of a block of contacts in the frame of its stone.
LaneVector side_direction(const StoneLanes &stone, const LaneVector &world)
{
  return to_body(stone.quad(at_orientation), world);
}

/// Renews the sides that no longer hold for `direction`.
void refresh_side(const Task &task, const Side &side, std::int64_t k, int which,
                  const LaneVector &direction, const LaneMask &is_looked_at)
{
  const LaneVector away = direction - load_vector(side.direction, k);
  const LaneMask is_stale =
      is_looked_at &&
      dot(away, away) > task.refresh_tolerance * task.refresh_tolerance;
  if (!any(is_stale))
    return;
  LaneTable<4> table;
  table.set(0, {direction});
  for (int lane = 0; lane < n_lanes; ++lane)
    if (is_stale[static_cast<std::size_t>(lane)])
      task.surfaces.renew(task.surfaces.owner, k + lane, which,
                          table.value[lane]);
}

/// r at `direction` from the expansions: r + g.w + w.H.w / 2.
Lanes expanded_radius(const Side &side, std::int64_t k,
                      const LaneVector &direction)
{
  const LaneVector w = direction - load_vector(side.direction, k);
  const LaneVector gradient = load_vector(side.gradient, k);
  const Lanes diagonal = load(side.hessian[0] + k) * w.x * w.x +
                         load(side.hessian[1] + k) * w.y * w.y +
                         load(side.hessian[2] + k) * w.z * w.z;
  const Lanes mixed = load(side.hessian[3] + k) * w.x * w.y +
                      load(side.hessian[4] + k) * w.x * w.z +
                      load(side.hessian[5] + k) * w.y * w.z;
  return load(side.radius + k) + dot(gradient, w) + 0.5 * diagonal + mixed;
}

/// The normal energy is that of a Hertz spring.
ContactHistory<Lanes> load_history(const Contacts &contacts, std::int64_t k,
                                   const Lanes &overlap_before)
{
  ContactHistory<Lanes> history;
  history.shear = load_vector(contacts.shear, k);
  if (contacts.rolling.x)
  {
    history.rolling = load_vector(contacts.rolling, k);
    history.rolling_compliance = load(contacts.rolling_compliance + k);
  }
  history.dashpot = load_vector(contacts.dashpot, k);
  history.shear_compliance = load(contacts.shear_compliance + k);
  history.normal_force = load(contacts.normal_force + k);
  history.normal_energy =
      hertz_energy_share * history.normal_force * overlap_before;
  return history;
}

/// Force on A as the last step left it.
LaneVector kept_force(const ContactHistory<Lanes> &history,
                      const LaneVector &normal)
{
  return history.shear + history.dashpot - history.normal_force * normal;
}

void store_history(const ContactHistory<Lanes> &history,
                   const Contacts &contacts, std::int64_t k)
{
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

/// Where the load of a contact on its side A goes: to the stone, or to the sum
/// of the range for the first stone of it.
struct Target
{
  std::int32_t first;
  RangeSum &sum;

  double *row(const Task &task, std::int32_t stone) const
  {
    return stone == first
               ? sum.load
               : task.stones.load + load_row * static_cast<std::int64_t>(stone);
  }
};

/// Where the load on side B goes: to the stone, or to a row of the halo.
double *partner_load(const Task &task, std::int32_t target)
{
  const std::int64_t row = target;
  return row >= 0 ? task.stones.load + load_row * row
                  : task.stones.halo + load_row * (-1 - row);
}

/// Adds force and moment to a row.
void add_load(const double *load, double *row)
{
  store_pack(load_pack<4>(row) + load_pack<4>(load), row);
  store_pack(load_pack<2>(row + 4) + load_pack<2>(load + 4), row + 4);
}

/// Overlap and elastic energy of a set of lanes, now and in the last step.
struct Loading
{
  Lanes overlap, energy_before, energy;
};

/// Eqs. 4 and 5 for one side of the contacts; an open contact loses its factor.
/// `bit` names the side in the events.
void damage_side(const Task &task, std::int64_t k, const Loading &loading,
                 const float *corner, double *factor, unsigned bit,
                 RangeSum &sum)
{
  const LaneMask is_touching = loading.overlap > 0.;
  const Lanes slope = load(corner + k), old = load(factor + k);
  const LaneMask is_at_risk = is_touching && slope > 0.;
  if (!any(is_at_risk) && !any(!is_touching && old != 0.))
    return;
  const DamageStep<Lanes> step = damage_step(
      old, loading.energy_before, loading.energy,
      select(is_at_risk, task.fracture_energy * slope * loading.overlap,
             Lanes(1.)));
  const LaneMask is_kept = is_touching || LaneMask(task.keeps_factors);
  const LaneMask grows = is_at_risk && LaneMask(task.repetitions > 0.);
  store(select(grows, step.factor, select(is_kept, old, Lanes(0.))),
        factor + k);
  const LaneMask breaks = grows && (step.factor > 1. || step.energy_ratio > 1.);
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

/// The energies that the criterion compares, where they are not those of the
/// normal spring in the last step and in this one.
Loading counted_loading(const Task &task, std::int64_t k,
                        const Loading &loading)
{
  const Contacts &contacts = task.contacts;
  Loading counted = loading;
  if (task.counts_shear)
  {
    const LaneVector shear = load_vector(contacts.shear, k);
    counted.energy +=
        0.5 * dot(shear, shear) * load(contacts.shear_compliance + k);
  }
  const CountedEnergy<Lanes> passed =
      count_energy(load(contacts.turn + k), counted.energy, task.hysteresis);
  counted.energy_before = passed.from;
  store(passed.turn, contacts.turn + k);
  return counted;
}

/// The same with rises beyond the peak that count many times.
Loading repeated_loading(const Task &task, std::int64_t k,
                         const Loading &loading)
{
  const Lanes peak = load(task.contacts.peak + k);
  const Lanes reached = max(peak, loading.energy);
  const Lanes fresh = loading.energy - max(peak, loading.energy_before);
  Loading repeated = loading;
  repeated.energy_before -= (task.repetitions - 1.) * max(Lanes(0.), fresh);
  store(reached, task.contacts.peak + k);
  return repeated;
}

/// Marks the contacts that begin or end.
void mark_switched(const Task &task, std::int64_t k, const Loading &last,
                   RangeSum &sum)
{
  const LaneMask has_switched =
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
  Loading loading = contacts.turn ? counted_loading(task, k, last) : last;
  if (contacts.peak)
    loading = repeated_loading(task, k, loading);
  damage_side(task, k, loading, contacts.corner_a, contacts.factor_a, 1u, sum);
  if (contacts.corner_b)
    damage_side(task, k, loading, contacts.corner_b, contacts.factor_b, 2u,
                sum);
}
} // namespace
} // namespace dem::kernel
