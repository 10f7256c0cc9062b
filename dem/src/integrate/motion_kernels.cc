// Compiled once per instruction set, with SPALL_INSTRUCTION_SET its name.
#include "motion_kernels.h"

#include "../simd_rows.h"

#include <dem/integrate/rotation.h>

namespace dem::kernel
{
namespace
{
using FrameSimd = SimdRows<frame_row>;

/// Particles in a row; the last stands again in lanes that are past the end.
struct LaneRows
{
  std::int64_t first, last;

  bool are_all_there() const { return last - first >= n_lanes; }
  std::int64_t operator[](int lane) const
  {
    return first + lane < last ? first + lane : last - 1;
  }
};

/// Some particles with all that moves them. Simd past the end work on the last
/// particle too, with the same result.
struct Movers
{
  SimdRows<particle_row, double> state;
  SimdRows<load_row, double> load;
  SimdVector velocity, spin;
  SimdVector force, moment; ///< loads
  Simd mass, inertia;
  Turn<Simd> orientation;
  // With shapes.
  SimdVector moments;
  Simd reach;
  Turn<Simd> principal;

  Movers(const Motion &motion, const LaneRows &rows)
      : state(motion.state, rows), load(motion.load, rows)
  {
    const SimdQuad moving = state.quad(at_velocity),
                   turning = state.quad(at_spin);
    velocity = moving.vector;
    mass = moving.number;
    spin = turning.vector;
    inertia = turning.number;
    const SimdQuad first = load.quad(0), rest = load.quad(4);
    force = first.vector;
    moment = {first.number, rest.vector.x, rest.vector.y};
    if (!motion.frame)
      return;
    orientation = turn(state.quad(at_orientation));
    const FrameSimd frame(motion.frame, rows);
    const SimdQuad size = frame.quad(at_moments);
    moments = size.vector;
    reach = size.number;
    principal = turn(frame.quad(at_principal));
  }

  static Turn<Simd> turn(const SimdQuad &quad)
  {
    return {quad.vector, quad.number};
  }
};

/// Part of a load that local damping leaves: F - D |F| sgn(v).
Simd brake(const Simd &load, double damping, const Simd &rate)
{
  const Simd size = damping * stdx::abs(load);
  return load -
         select(rate > 0., size, select(rate < 0., Simd(-size), Simd(0.)));
}

SimdVector brake(const SimdVector &load, double damping, const SimdVector &rate)
{
  return {brake(load.x, damping, rate.x), brake(load.y, damping, rate.y),
          brake(load.z, damping, rate.z)};
}

/// The inverse of the inertia tensor times a moment.
SimdVector over_inertia(const Motion &motion, const Movers &particles,
                        const SimdVector &moment)
{
  if (!motion.has_tensors)
    return 1. / particles.inertia * moment;
  const Turn<Simd> to_world = particles.orientation * particles.principal;
  const SimdVector inner = inverse(to_world) * moment;
  const SimdVector &of = particles.moments;
  return to_world * SimdVector{inner.x / of.x, inner.y / of.y, inner.z / of.z};
}

/// Adds `value` of the first lanes to a column.
void add_to(double *column, const LaneRows &rows, const Simd &value)
{
  double *first = column + rows.first;
  if (rows.are_all_there())
    store(load(first) + value, first);
  else
    for (std::int64_t lane = 0; lane < rows.last - rows.first; ++lane)
      first[lane] += value[static_cast<std::size_t>(lane)];
}

/// v += F/m dt, omega += I^-1 M dt with what local damping leaves of F and M;
/// books the work of damping and gravity.
void kick(const Motion &motion, double dt, const LaneRows &rows,
          Movers &particles)
{
  const SimdVector velocity = particles.velocity, spin = particles.spin;
  const SimdVector weight{particles.mass * motion.gravity[0],
                          particles.mass * motion.gravity[1],
                          particles.mass * motion.gravity[2]};
  const SimdVector force = particles.force + weight, moment = particles.moment;
  SimdVector kept_force = force, kept_moment = moment;
  if (motion.damped)
  {
    kept_force = brake(force, motion.local_damping, velocity);
    kept_moment = brake(moment, motion.local_damping, spin);
  }
  particles.velocity += dt / particles.mass * kept_force;
  particles.spin += Simd(dt) * over_inertia(motion, particles, kept_moment);
  if (motion.damped)
    add_to(motion.damped, rows,
           0.5 * dt *
               (dot(force - kept_force, velocity + particles.velocity) +
                dot(moment - kept_moment, spin + particles.spin)));
  if (motion.lifted)
    add_to(motion.lifted, rows,
           0.5 * dt * dot(weight, velocity + particles.velocity));
}

void turn(const Motion &motion, Movers &particles)
{
  if (!motion.frame)
    return;
  if (!motion.has_tensors)
  {
    particles.orientation =
        normalised(exponential(Simd(motion.drift) * particles.spin) *
                   particles.orientation);
    return;
  }
  Rotor<Simd> rotor{particles.moments,
                    particles.orientation * particles.principal,
                    particles.spin};
  turn_freely(rotor, motion.drift);
  particles.spin = rotor.spin;
  particles.orientation = rotor.to_world * inverse(particles.principal);
}

double largest(const Simd &value)
{
  return stdx::hmax(value);
}

/// How fast the particles are, after the drift.
Fastest note_speeds(const Motion &motion, const LaneRows &rows,
                    const Movers &particles)
{
  const Simd square = dot(particles.velocity, particles.velocity);
  Fastest speeds{largest(square), 0.};
  if (!motion.frame)
    return speeds;
  const Simd closing =
      (1. + motion.steepness) * stdx::sqrt(square) +
      particles.reach * stdx::sqrt(dot(particles.spin, particles.spin));
  speeds.closing = largest(closing);
  if (motion.path_length)
    add_to(motion.path_length, rows, motion.drift * closing);
  return speeds;
}

/// Adds zero times what is stored to `check`: NaN if it is not finite.
void store_positions(const Motion &motion, const Movers &particles, Simd &check)
{
  const SimdQuad sphere = particles.state.quad(at_position);
  const SimdVector moved =
      sphere.vector + Simd(motion.drift) * particles.velocity;
  particles.state.set(at_position, {moved, sphere.number});
  if (motion.frame)
    particles.state.set(at_orientation, {particles.orientation.vector,
                                         particles.orientation.number});
  particles.load.set(0, {});
  particles.load.set(4, {});
  check += 0. * (moved.x + moved.y + moved.z + particles.spin.x +
                 particles.spin.y + particles.spin.z);
}

[[gnu::flatten]] Fastest move_some(const Motion &motion, const LaneRows &rows,
                                   Simd &check)
{
  Movers particles(motion, rows);
  if (motion.owed > 0.)
    kick(motion, motion.owed, rows, particles);
  kick(motion, motion.kick, rows, particles);
  Fastest speeds;
  if (motion.drift > 0.)
  {
    turn(motion, particles);
    speeds = note_speeds(motion, rows, particles);
    store_positions(motion, particles, check);
  }
  particles.state.set(at_velocity, {particles.velocity, particles.mass});
  particles.state.set(at_spin, {particles.spin, particles.inertia});
  return speeds;
}

Fastest move_range(const Motion &motion, std::int64_t first, std::int64_t last)
{
  Fastest fastest;
  Simd check = 0.;
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
