#include <dem/integrate/verlet.h>
#include <dem/search/candidates.h>

#include <cmath>

namespace dem
{
namespace
{
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

template <bool is_damped>
void kick_stones(Particles &particles, const KickParameters &parameters,
                 double time_step, WorkColumns &work)
{
  const bool is_lifted = !parameters.gravity.isZero(0.);
  const double damping = parameters.local_damping;
  const auto n = static_cast<std::int64_t>(particles.size());
#pragma omp parallel for schedule(static)
  for (std::int64_t entry = 0; entry < n; ++entry)
  {
    const auto i = static_cast<std::size_t>(entry);
    Vec3 &velocity = particles.velocity(i), &spin = particles.spin(i);
    const double mass = particles.mass(i);
    const Vec3 before = velocity, weight = mass * parameters.gravity;
    double taken =
        kick_vector<is_damped>(particles.load[i].force + weight,
                               time_step / mass, damping, time_step, velocity);
    taken += kick_vector<is_damped>(particles.load[i].moment,
                                    time_step / particles.inertia(i), damping,
                                    time_step, spin);
    if (is_damped)
      work.damped[i] += taken;
    if (is_lifted)
      work.lifted[i] += weight.dot(before + velocity) * 0.5 * time_step;
  }
}

/// exp(rotation vector) as a quaternion.
Quaternion exponential(const Vec3 &rotation)
{
  const double angle = rotation.norm();
  // sin(x/2)/x to fourth order where the quotient would lose digits.
  const double factor =
      angle > 1e-4 ? std::sin(0.5 * angle) / angle : 0.5 - angle * angle / 48.;
  const Vec3 axis = factor * rotation;
  return {std::cos(0.5 * angle), axis.x(), axis.y(), axis.z()};
}
} // namespace

void kick(Particles &particles, const KickParameters &parameters,
          double time_step, WorkColumns &work)
{
  if (parameters.local_damping > 0.)
    kick_stones<true>(particles, parameters, time_step, work);
  else
    kick_stones<false>(particles, parameters, time_step, work);
}

Speeds drift(Particles &particles, double steepness, double time_step)
{
  const auto n = static_cast<std::int64_t>(particles.size());
  double moving = 0., closing = 0.;
#pragma omp parallel for schedule(static) reduction(max : moving, closing)
  for (std::int64_t entry = 0; entry < n; ++entry)
  {
    const auto i = static_cast<std::size_t>(entry);
    particles.position(i) += time_step * particles.velocity(i);
    moving = std::max(moving, particles.velocity(i).squaredNorm());
    if (!particles.has_shapes)
      continue;
    Quaternion &q = particles.orientation(i);
    q = (exponential(time_step * particles.spin(i)) * q).normalized();
    closing = std::max(closing, closing_speed(particles, i, steepness));
  }
  moving = std::sqrt(moving);
  return {moving, std::max(closing, moving)};
}
} // namespace dem
