#include <dem/integrate/rotation.h>
#include <dem/integrate/verlet.h>
#include <dem/search/candidates.h>

#include <cmath>

namespace dem
{
namespace
{
/// Below this many stones a second thread costs more than it saves here.
constexpr std::int64_t shared_from = 2000;

/// Part of a load that local damping leaves: F - D |F| sgn(v).
double brake(double load, double damping, double rate)
{
  return rate == 0. ? load
                    : load - damping * std::abs(load) * std::copysign(1., rate);
}

/// Adds `load` dt / `inertia` to `rate`; with damping, returns what it took.
template <bool is_damped>
double kick_vector(const Vec3 &load, double dt_over_inertia, double damping,
                   double dt, Vec3 &rate)
{
  if constexpr (!is_damped)
  {
    rate += dt_over_inertia * load;
    return 0.;
  }
  double taken = 0.;
  for (int d = 0; d < 3; ++d)
  {
    const double braked = brake(load[d], damping, rate[d]), before = rate[d];
    rate[d] += dt_over_inertia * braked;
    taken += (load[d] - braked) * 0.5 * (before + rate[d]) * dt;
  }
  return taken;
}

/// The moment that local damping leaves turns the stone with its whole inertia
/// tensor; returns what damping took.
template <bool is_damped>
double kick_spin(Particles &particles, std::size_t i, double damping, double dt)
{
  Vec3 &spin = particles.spin(i);
  const Vec3 before = spin, &moment = particles.load[i].moment;
  Vec3 braked = moment;
  if constexpr (is_damped)
    for (int d = 0; d < 3; ++d)
      braked[d] = brake(moment[d], damping, before[d]);
  spin += dt * particles.over_inertia(i, braked);
  return is_damped ? (moment - braked).dot(0.5 * dt * (before + spin)) : 0.;
}

/// Half a kick of stone i with what acts on it.
template <bool is_damped>
void kick_stone(Particles &particles, std::size_t i,
                const KickParameters &parameters, double time_step,
                WorkColumns &work)
{
  StoneState &stone = particles.state[i];
  const StoneLoad &load = particles.load[i];
  const Vec3 before = stone.velocity, weight = stone.mass * parameters.gravity;
  double taken = kick_vector<is_damped>(
      load.force + weight, time_step / stone.mass, parameters.local_damping,
      time_step, stone.velocity);
  taken += particles.follows_surfaces
               ? kick_spin<is_damped>(particles, i, parameters.local_damping,
                                      time_step)
               : kick_vector<is_damped>(load.moment, time_step / stone.inertia,
                                        parameters.local_damping, time_step,
                                        stone.spin);
  if (is_damped)
    work.damped[i] += taken;
  if (parameters.has_gravity())
    work.lifted[i] += weight.dot(before + stone.velocity) * 0.5 * time_step;
}

/// Turns stone i freely with its whole inertia tensor.
void turn_stone(Particles &particles, std::size_t i, double time_step)
{
  StoneState &stone = particles.state[i];
  const Body &body = particles.body[i];
  Rotor rotor{stone.mass * body.gyration, stone.orientation * body.principal,
              stone.spin};
  turn_freely(rotor, time_step);
  stone.spin = rotor.spin;
  stone.orientation = rotor.to_world * body.principal.conjugate();
}

/// Moves stone i; `moving` of what it returns is squared.
Speeds drift_stone(Particles &particles, std::size_t i, double steepness,
                   double time_step)
{
  StoneState &stone = particles.state[i];
  stone.position += time_step * stone.velocity;
  Speeds speeds{stone.velocity.squaredNorm(), 0.};
  if (!particles.has_shapes)
    return speeds;
  Quaternion &q = stone.orientation;
  if (particles.follows_surfaces)
    turn_stone(particles, i, time_step);
  else
    q = (exponential(time_step * stone.spin) * q).normalized();
  speeds.closing = closing_speed(particles, i, steepness);
  if (particles.follows_surfaces)
    particles.travelled[i] += time_step * speeds.closing;
  return speeds;
}

/// Calls call(i) for all stones by several threads.
template <class Call>
void for_each_stone(std::size_t n_stones, const Call &call)
{
  const auto n = static_cast<std::int64_t>(n_stones);
#pragma omp parallel for schedule(static) if (n >= shared_from)
  for (std::int64_t i = 0; i < n; ++i)
    call(static_cast<std::size_t>(i));
}

template <bool is_damped>
Speeds kick_and_drift_all(Particles &particles, const StartOfStep &start,
                          WorkColumns &work)
{
  const auto n = static_cast<std::int64_t>(particles.size());
  double moving = 0., closing = 0.;
#pragma omp parallel for schedule(static)                                      \
    reduction(max                                                              \
              : moving, closing) if (n >= shared_from)
  for (std::int64_t entry = 0; entry < n; ++entry)
  {
    const auto i = static_cast<std::size_t>(entry);
    kick_stone<is_damped>(particles, i, start.kick, 0.5 * start.time_step,
                          work);
    particles.load[i] = StoneLoad{};
    const Speeds speeds =
        drift_stone(particles, i, start.steepness, start.time_step);
    moving = std::max(moving, speeds.moving);
    closing = std::max(closing, speeds.closing);
  }
  moving = std::sqrt(moving);
  return {moving, std::max(closing, moving)};
}
} // namespace

Speeds kick_and_drift(Particles &particles, const StartOfStep &start,
                      WorkColumns &work)
{
  return start.kick.local_damping > 0.
             ? kick_and_drift_all<true>(particles, start, work)
             : kick_and_drift_all<false>(particles, start, work);
}

void kick(Particles &particles, const KickParameters &parameters,
          double time_step, WorkColumns &work)
{
  if (parameters.local_damping > 0.)
    for_each_stone(
        particles.size(), [&](std::size_t i)
        { kick_stone<true>(particles, i, parameters, time_step, work); });
  else
    for_each_stone(
        particles.size(), [&](std::size_t i)
        { kick_stone<false>(particles, i, parameters, time_step, work); });
}
} // namespace dem
