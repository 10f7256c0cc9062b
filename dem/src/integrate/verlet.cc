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

/// exp(rotation vector) as a quaternion.
Quaternion exponential(const Vec3 &rotation)
{
  const double half_square = 0.25 * rotation.squaredNorm(); // of half the angle
  double cosine = 0., factor = 0.;                          // sin(x/2) / x
  if (half_square < 2.5e-3)
  {
    // The next terms are below 1e-15.
    cosine = 1. - half_square *
                      (1. / 2. -
                       half_square * (1. / 24. - half_square * (1. / 720.)));
    factor = 0.5 - half_square *
                       (1. / 12. - half_square * (1. / 240. -
                                                  half_square * (1. / 10080.)));
  }
  else
  {
    const double half = std::sqrt(half_square);
    cosine = std::cos(half);
    factor = 0.5 * std::sin(half) / half;
  }
  const Vec3 axis = factor * rotation;
  return {cosine, axis.x(), axis.y(), axis.z()};
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
  taken +=
      kick_vector<is_damped>(load.moment, time_step / stone.inertia,
                             parameters.local_damping, time_step, stone.spin);
  if (is_damped)
    work.damped[i] += taken;
  if (parameters.has_gravity())
    work.lifted[i] += weight.dot(before + stone.velocity) * 0.5 * time_step;
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
  q = (exponential(time_step * stone.spin) * q).normalized();
  speeds.closing = closing_speed(particles, i, steepness);
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
