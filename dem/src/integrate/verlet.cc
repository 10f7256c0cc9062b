#include <dem/integrate/verlet.h>
#include <dem/search/candidates.h>

#include <cmath>

namespace dem
{
namespace
{
/// Adds `load` / `inertia` dt to `rate` with local damping; returns what the
/// damping took.
double kick_component(double load, double inertia, double damping, double dt,
                      double &rate)
{
  const double braked =
      rate == 0. ? load
                 : load - damping * std::abs(load) * std::copysign(1., rate);
  const double before = rate;
  rate += braked / inertia * dt;
  return (load - braked) * 0.5 * (before + rate) * dt;
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
          double time_step, std::vector<double> &damped,
          std::vector<double> &lifted)
{
  const auto n = static_cast<std::int64_t>(particles.size());
#pragma omp parallel for schedule(static)
  for (std::int64_t entry = 0; entry < n; ++entry)
  {
    const auto i = static_cast<std::size_t>(entry);
    Vec3 &v = particles.velocity[i];
    const Vec3 before = v;
    const Vec3 weight = particles.mass[i] * parameters.gravity;
    for (int d = 0; d < 3; ++d)
    {
      damped[i] +=
          kick_component(particles.force[i][d] + weight[d], particles.mass[i],
                         parameters.local_damping, time_step, v[d]);
      damped[i] += kick_component(particles.moment[i][d], particles.inertia[i],
                                  parameters.local_damping, time_step,
                                  particles.spin[i][d]);
    }
    lifted[i] += weight.dot(before + v) * 0.5 * time_step;
  }
}

Speeds drift(Particles &particles, double steepness, double time_step)
{
  const auto n = static_cast<std::int64_t>(particles.size());
  double moving = 0., closing = 0.;
#pragma omp parallel for schedule(static) reduction(max : moving, closing)
  for (std::int64_t entry = 0; entry < n; ++entry)
  {
    const auto i = static_cast<std::size_t>(entry);
    particles.position[i] += time_step * particles.velocity[i];
    Quaternion &q = particles.orientation[i];
    q = (exponential(time_step * particles.spin[i]) * q).normalized();
    particles.rotation[i] = q.toRotationMatrix();
    moving = std::max(moving, particles.velocity[i].norm());
    closing = std::max(closing, closing_speed(particles, i, steepness));
  }
  return {moving, closing};
}
} // namespace dem
