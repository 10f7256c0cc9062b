// Compiled once per instruction set, with SPALL_INSTRUCTION_SET its name.
#include "motion_kernels.h"

#include "../contact/lane_rows.h"

#include <dem/integrate/rotation.h>

namespace dem::kernel
{
namespace
{
using FrameLanes = LaneRows<frame_row>;

/// Stones in a row; the last stands again in lanes that are past the end.
struct Places
{
  std::int64_t first, last;

  bool are_all_there() const { return last - first >= n_lanes; }
  std::int64_t operator[](int lane) const
  {
    return first + lane < last ? first + lane : last - 1;
  }
};

/// Some stones with all that moves them. Lanes past the end work on the last
/// stone too, with the same result.
struct Movers
{
  LaneRows<stone_row, double> state;
  LaneRows<load_row, double> load;
  LaneVector velocity, spin;
  Lanes mass, inertia;
  Turn<Lanes> orientation;
  // With shapes.
  LaneVector moments;
  Lanes reach;
  Turn<Lanes> principal;

  Movers(const Motion &motion, const Places &places)
      : state(motion.state, places), load(motion.load, places)
  {
    const LaneQuad moving = state.quad(at_velocity),
                   turning = state.quad(at_spin);
    velocity = moving.vector;
    mass = moving.number;
    spin = turning.vector;
    inertia = turning.number;
    if (!motion.frame)
      return;
    orientation = turn(state.quad(at_orientation));
    const FrameLanes frame(motion.frame, places);
    const LaneQuad size = frame.quad(at_moments);
    moments = size.vector;
    reach = size.number;
    principal = turn(frame.quad(at_principal));
  }

  static Turn<Lanes> turn(const LaneQuad &quad)
  {
    return {quad.vector, quad.number};
  }
};

/// Part of a load that local damping leaves: F - D |F| sgn(v).
Lanes brake(const Lanes &load, double damping, const Lanes &rate)
{
  const Lanes size = damping * stdx::abs(load);
  return load -
         select(rate > 0., size, select(rate < 0., Lanes(-size), Lanes(0.)));
}

LaneVector brake(const LaneVector &load, double damping, const LaneVector &rate)
{
  return {brake(load.x, damping, rate.x), brake(load.y, damping, rate.y),
          brake(load.z, damping, rate.z)};
}

/// The inverse of the inertia tensor times a moment.
LaneVector over_inertia(const Motion &motion, const Movers &stones,
                        const LaneVector &moment)
{
  if (!motion.has_tensors)
    return 1. / stones.inertia * moment;
  const Turn<Lanes> to_world = stones.orientation * stones.principal;
  const LaneVector inner = inverse(to_world) * moment;
  const LaneVector &of = stones.moments;
  return to_world * LaneVector{inner.x / of.x, inner.y / of.y, inner.z / of.z};
}

/// Adds `value` of the first lanes to a column.
void add_to(double *column, const Places &places, const Lanes &value)
{
  double *first = column + places.first;
  if (places.are_all_there())
    store(load(first) + value, first);
  else
    for (std::int64_t lane = 0; lane < places.last - places.first; ++lane)
      first[lane] += value[static_cast<std::size_t>(lane)];
}

/// v += F/m dt, omega += I^-1 M dt with what local damping leaves of F and M;
/// books the work of damping and gravity.
void kick(const Motion &motion, double dt, const Places &places, Movers &stones)
{
  const LaneVector velocity = stones.velocity, spin = stones.spin;
  const LaneVector weight{stones.mass * motion.gravity[0],
                          stones.mass * motion.gravity[1],
                          stones.mass * motion.gravity[2]};
  const LaneQuad first = stones.load.quad(0), rest = stones.load.quad(4);
  const LaneVector force = first.vector + weight,
                   moment{first.number, rest.vector.x, rest.vector.y};
  LaneVector kept_force = force, kept_moment = moment;
  if (motion.damped)
  {
    kept_force = brake(force, motion.local_damping, velocity);
    kept_moment = brake(moment, motion.local_damping, spin);
  }
  stones.velocity += dt / stones.mass * kept_force;
  stones.spin += Lanes(dt) * over_inertia(motion, stones, kept_moment);
  if (motion.damped)
    add_to(motion.damped, places,
           0.5 * dt *
               (dot(force - kept_force, velocity + stones.velocity) +
                dot(moment - kept_moment, spin + stones.spin)));
  if (motion.lifted)
    add_to(motion.lifted, places,
           0.5 * dt * dot(weight, velocity + stones.velocity));
}

void turn(const Motion &motion, Movers &stones)
{
  if (!motion.frame)
    return;
  if (!motion.has_tensors)
  {
    stones.orientation = normalised(
        exponential(Lanes(motion.drift) * stones.spin) * stones.orientation);
    return;
  }
  Rotor<Lanes> rotor{stones.moments, stones.orientation * stones.principal,
                     stones.spin};
  turn_freely(rotor, motion.drift);
  stones.spin = rotor.spin;
  stones.orientation = rotor.to_world * inverse(stones.principal);
}

double largest(const Lanes &value)
{
  return stdx::hmax(value);
}

/// How fast the stones are, after the drift.
Fastest note_speeds(const Motion &motion, const Places &places,
                    const Movers &stones)
{
  const Lanes square = dot(stones.velocity, stones.velocity);
  Fastest speeds{largest(square), 0.};
  if (!motion.frame)
    return speeds;
  const Lanes closing =
      (1. + motion.steepness) * stdx::sqrt(square) +
      stones.reach * stdx::sqrt(dot(stones.spin, stones.spin));
  speeds.closing = largest(closing);
  if (motion.travelled)
    add_to(motion.travelled, places, motion.drift * closing);
  return speeds;
}

/// Adds zero times what is stored to `check`: NaN if it is not finite.
void store_places(const Motion &motion, const Movers &stones, Lanes &check)
{
  const LaneQuad ball = stones.state.quad(at_position);
  const LaneVector moved = ball.vector + Lanes(motion.drift) * stones.velocity;
  stones.state.set(at_position, {moved, ball.number});
  if (motion.frame)
    stones.state.set(at_orientation,
                     {stones.orientation.vector, stones.orientation.number});
  stones.load.set(0, {});
  stones.load.set(4, {});
  check += 0. * (moved.x + moved.y + moved.z + stones.spin.x + stones.spin.y +
                 stones.spin.z);
}

[[gnu::flatten]] Fastest move_some(const Motion &motion, const Places &places,
                                   Lanes &check)
{
  Movers stones(motion, places);
  if (motion.owed > 0.)
    kick(motion, motion.owed, places, stones);
  kick(motion, motion.kick, places, stones);
  Fastest speeds;
  if (motion.drift > 0.)
  {
    turn(motion, stones);
    speeds = note_speeds(motion, places, stones);
    store_places(motion, stones, check);
  }
  stones.state.set(at_velocity, {stones.velocity, stones.mass});
  stones.state.set(at_spin, {stones.spin, stones.inertia});
  return speeds;
}

Fastest move_range(const Motion &motion, std::int64_t first, std::int64_t last)
{
  Fastest fastest;
  Lanes check = 0.;
  for (std::int64_t k = first; k < last; k += n_lanes)
  {
    const Fastest speeds = move_some(motion, {k, last}, check);
    fastest.moving =
        fastest.moving > speeds.moving ? fastest.moving : speeds.moving;
    fastest.closing =
        fastest.closing > speeds.closing ? fastest.closing : speeds.closing;
  }
  fastest.check = stdx::reduce(check);
  return fastest;
}
} // namespace

namespace SPALL_INSTRUCTION_SET
{
extern const MotionLoop motion_loop;
const MotionLoop motion_loop = move_range;
} // namespace SPALL_INSTRUCTION_SET
} // namespace dem::kernel
