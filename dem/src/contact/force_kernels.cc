// Compiled once per instruction set, with SPALL_INSTRUCTION_SET its name.
#include "force_kernels.h"

#include "lanes.h"

#include <dem/breakage/criterion.h>

namespace dem::kernel
{
namespace
{
/// Lanes that are worked on in turn make one block of 8 for every instruction
/// set, and losses are summed by place in the block: same digits everywhere.
constexpr int block = 8;
constexpr int n_parts = block / n_lanes;
using BlockLosses = Losses<Lanes>[n_parts];
using StoneLanes = LaneRows<stone_row>;

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
  LaneTable<3> table;
  table.set(0, direction);
  for (int lane = 0; lane < n_lanes; ++lane)
    if (is_stale[static_cast<std::size_t>(lane)])
    {
      const double body_direction[3] = {
          table.value[0][lane], table.value[1][lane], table.value[2][lane]};
      task.surfaces.renew(task.surfaces.owner, k + lane, which, body_direction);
    }
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

ContactHistory<Lanes> load_history(const Contacts &contacts, std::int64_t k,
                                   const Lanes &overlap_before,
                                   double energy_share)
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
  history.normal_energy = energy_share * history.normal_force * overlap_before;
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

/// Adds six numbers of a lane to a row.
template <int n_values>
void add_load(const LaneTable<n_values> &table, int first_value, int lane,
              double *row)
{
  for (int c = 0; c < 6; ++c)
    row[c] += table.value[first_value + c][lane];
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
  store(select(is_at_risk, step.factor, select(is_touching, old, Lanes(0.))),
        factor + k);
  const LaneMask breaks =
      is_at_risk && (step.factor > 1. || step.energy_ratio > 1.);
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

void find_damage(const Task &task, std::int64_t k, const Loading &loading,
                 RangeSum &sum)
{
  const Contacts &contacts = task.contacts;
  damage_side(task, k, loading, contacts.corner_a, contacts.factor_a, 1u, sum);
  if (contacts.corner_b)
    damage_side(task, k, loading, contacts.corner_b, contacts.factor_b, 2u,
                sum);
}

// ---------------------------------------------------------------------------
// Stone against stone
// ---------------------------------------------------------------------------

/// Contacts of one set of lanes as they lie.
struct PairGeometry
{
  LaneVector normal;
  Lanes inverse_distance;   ///< of the centres; 0 where they coincide
  Lanes radius_a, radius_b; ///< towards each other
  Lanes overlap;            ///< 0 where open

  /// From the centres to the middle of the overlap.
  Lanes arm_a() const { return radius_a - 0.5 * overlap; }
  Lanes arm_b() const { return radius_b - 0.5 * overlap; }
};

PairGeometry locate_pairs(const Task &task, std::int64_t k, const StoneLanes &a,
                          const StoneLanes &b)
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
    refresh_side(task, task.contacts.side_a, k, 0, on_a, is_apart);
    refresh_side(task, task.contacts.side_b, k, 1, on_b, is_apart);
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
  pair.overlap = select(
      is_apart, stdx::max(pair.radius_a + pair.radius_b - distance, Lanes(0.)),
      Lanes(0.));
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
  LaneTable<3> table;
  table.set(0, pair.normal);
  for (int lane = 0; lane < n_lanes; ++lane)
    if (is_old[static_cast<std::size_t>(lane)])
    {
      const double normal[3] = {table.value[0][lane], table.value[1][lane],
                                table.value[2][lane]};
      task.surfaces.mix(task.surfaces.owner, k + lane, normal);
    }
}

/// Loads on stones A and B: forces, then moments.
struct PairLoad
{
  LaneVector force_a, moment_a, force_b, moment_b;
};

void scatter_pairs(const Task &task, std::int64_t k, int n_valid,
                   const PairLoad &load, const Target &target)
{
  LaneTable<12> table;
  table.set(0, load.force_a);
  table.set(3, load.moment_a);
  table.set(6, load.force_b);
  table.set(9, load.moment_b);
  for (int lane = 0; lane < n_valid; ++lane)
  {
    add_load(table, 0, lane, target.row(task, task.contacts.a[k + lane]));
    add_load(table, 6, lane,
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
  // Entries that only fill the last block know no radius.
  motion.rolling_radius =
      pair.radius_a * pair.radius_b /
      select(pair.overlap > 0., pair.radius_a + pair.radius_b, Lanes(1.));
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
  const Lanes root = stdx::sqrt(motion.rolling_radius);
  return hertz_spring(Lanes(task.normal_factor * root),
                      Lanes(task.shear_factor * root), pair.overlap);
}

/// One step of `n_valid` contacts from k.
[[gnu::flatten]] void advance_pairs(const Task &task, std::int64_t k,
                                    int n_valid, Losses<Lanes> &lost,
                                    const Target &target)
{
  const Contacts &contacts = task.contacts;
  const StoneLanes a(task.stones.state, contacts.a + k),
      b(task.stones.state, contacts.b + k);
  const PairGeometry pair = locate_pairs(task, k, a, b);
  const Lanes overlap_before = load(contacts.overlap + k);
  if (!any(pair.overlap > 0. || overlap_before > 0.))
    return; // all is zero and stays so
  ContactHistory<Lanes> history =
      load_history(contacts, k, overlap_before, hertz_energy_share);
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

// ---------------------------------------------------------------------------
// Stone against wall
// ---------------------------------------------------------------------------

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

[[gnu::flatten]] void advance_walls(const Task &task, std::int64_t k,
                                    int n_valid, Losses<Lanes> &lost,
                                    const Target &target)
{
  const Contacts &contacts = task.contacts;
  const StoneLanes a(task.stones.state, contacts.a + k);
  const WallLanes wall(task.walls, contacts.b + k);
  const Lanes place([](auto lane) { return static_cast<double>(lane); });
  const WallGeometry geometry =
      locate_walls(task, k, a, wall, place < static_cast<double>(n_valid));
  const Lanes overlap_before = load(contacts.overlap + k);
  if (!any(geometry.overlap > 0. || overlap_before > 0.))
    return;
  ContactHistory<Lanes> history =
      load_history(contacts, k, overlap_before, linear_energy_share);
  const Lanes energy_before = history.normal_energy;
  LaneVector force;
  if (task.adds_loads_only)
    force = kept_force(history, geometry.normal);
  else
  {
    force = advance_contact(
        wall_motion(a, wall, geometry),
        linear_spring(task.normal_factor, task.shear_factor, geometry.overlap),
        task.coefficients, task.time_step, history, lost);
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

// ---------------------------------------------------------------------------

/// What the lanes have lost, place by place in the block.
void sum_losses(const BlockLosses &lost, Dissipation &sum)
{
  for (int part = 0; part < n_parts; ++part)
  {
    LaneTable<4> table;
    table.set(0, lost[part].friction);
    table.set(1, lost[part].rolling);
    table.set(2, lost[part].damping);
    table.set(3, lost[part].shape_work);
    for (int lane = 0; lane < n_lanes; ++lane)
    {
      sum.friction += table.value[0][lane];
      sum.rolling += table.value[1][lane];
      sum.damping += table.value[2][lane];
      sum.shape_work += table.value[3][lane];
    }
  }
}

template <auto advance>
void run_range(const Task &task, std::int64_t first, std::int64_t last,
               RangeSum &sum)
{
  const Target target{task.contacts.a[first], sum};
  BlockLosses lost;
  for (std::int64_t k = first; k < last; k += block)
    for (int part = 0; part < n_parts; ++part)
    {
      const std::int64_t from = k + part * n_lanes;
      const std::int64_t n_valid =
          last - from < n_lanes ? last - from : n_lanes;
      if (n_valid > 0)
        advance(task, from, static_cast<int>(n_valid), lost[part], target);
    }
  sum_losses(lost, sum.lost);
}
} // namespace

namespace SPALL_INSTRUCTION_SET
{
extern const Loops loops;
const Loops loops = {run_range<advance_pairs>, run_range<advance_walls>};
} // namespace SPALL_INSTRUCTION_SET
} // namespace dem::kernel
