#pragma once

#include <dem/particles/particle_system.h>

namespace dem
{
/// Input of the kicks.
struct KickParameters
{
  Vec3 gravity = Vec3::Zero(); ///< [m/s^2]
  double local_damping = 0.;   ///< D_a of F <- F - D_a |F| sgn(v) [-]

  bool has_gravity() const { return !gravity.isZero(0.); }
};

/// Work done on every particle since construction [J].
struct WorkColumns
{
  std::vector<double> damped; ///< taken by local damping
  std::vector<double> lifted; ///< by gravity
};

/// Fastest particles of a step.
struct Speeds
{
  double moving = 0.;  ///< |v| [m/s]
  double closing = 0.; ///< closing_speed [m/s]
  /// False if a position, a velocity or a spin is no finite number.
  bool is_finite = true;
};

/// Input of the first half of a step.
struct StartOfStep
{
  KickParameters kick;
  double steepness = 0.; ///< c of closing_speed [-]
  double owed = 0.;      ///< kick that the step before has left out [s]
  double time_step = 0.; ///< whole [s]
};

/// What is owed as kick() would give it, then
/// v += F/m dt/2, omega += M/I dt/2 with local damping per component, then
/// x += v dt, q <- exp(omega dt) q (where some particle is not a sphere), or a
/// free turn of the whole inertia tensor (Particles::follows_surfaces). Loads
/// are zero after it.
Speeds kick_and_drift(ParticleSystem &particles, const StartOfStep &start,
                      WorkColumns &work);

/// The kick alone, over `time_step` [s]: half a step.
void kick(ParticleSystem &particles, const KickParameters &parameters,
          double time_step, WorkColumns &work);
} // namespace dem
