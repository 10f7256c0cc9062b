#pragma once

#include <dem/particles.h>

namespace dem
{
/// What the kicks need to know.
struct KickParameters
{
  Vec3 gravity = Vec3::Zero(); ///< [m/s^2]
  double local_damping = 0.;   ///< D_a of F <- F - D_a |F| sgn(v) [-]
};

/// Work done on every stone since construction [J].
struct WorkColumns
{
  std::vector<double> damped; ///< taken by local damping
  std::vector<double> lifted; ///< by gravity
};

/// v += F dt, omega += M dt for every stone, `time_step` being half a step [s];
/// local damping per component.
void kick(Particles &particles, const KickParameters &parameters,
          double time_step, WorkColumns &work);

/// Fastest stones of a step.
struct Speeds
{
  double moving = 0.;  ///< |v| [m/s]
  double closing = 0.; ///< closing_speed [m/s]
};

/// x += v dt, q <- exp(omega dt) q (where some stone is not a sphere).
Speeds drift(Particles &particles, double steepness, double time_step);
} // namespace dem
