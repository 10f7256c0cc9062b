#pragma once

#include "../contact/force_kernels.h"

/// The loops over particles as they are compiled for each instruction set.
/// Plain pointers only, as in force_kernels.h.
namespace dem::kernel
{
/// TurningFrame in numbers, and where its fields are.
inline constexpr int frame_row = 8, at_moments = 0, at_reach = 3,
                     at_principal = 4;

/// What the loops read and write; columns that the scene lacks are null.
struct Motion
{
  double *state, *load; ///< ParticleState, ParticleLoad
  const double *frame;  ///< TurningFrame; null: spheres
  double *path_length;  ///< ParticleSystem::path_length, null: spheres
  bool has_tensors;     ///< particles turn with their whole tensors
  double *damped;       ///< WorkColumns, null without local damping
  double *lifted;       ///< null without gravity
  double gravity[3];    ///< [m/s^2]
  double local_damping; ///< [-]
  double steepness;     ///< StartOfStep
  double owed;          ///< of a kick before, 0: none [s]
  double kick, drift;   ///< [s]; drift 0: the kick alone
};

/// Of some particles, as Speeds.
struct Fastest
{
  double moving = 0.; ///< squared
  double closing = 0.;
  /// Zero times the position and all speeds: NaN if some of them is no finite
  /// number, which a maximum may pass over.
  double check = 0.;
};

/// Moves the particles [first, last).
using MotionLoop = Fastest (*)(const Motion &motion, std::int64_t first,
                               std::int64_t last);

/// That of the instruction set in use.
MotionLoop motion_loop();

namespace baseline
{
extern const MotionLoop motion_loop;
}
namespace avx2
{
extern const MotionLoop motion_loop;
}
namespace avx512
{
extern const MotionLoop motion_loop;
}
} // namespace dem::kernel
