#pragma once

#include <dem/vector.h>

#include <cstdint>

namespace dem
{
/// A rigid plane that moves without turning; particles are on the side of the
/// normal. No byte of it is unused, so that checkpoints of equal planes are
/// equal.
struct Plane
{
  Vec3 point = Vec3::Zero();    ///< any point of it [m]
  Vec3 normal = Vec3::UnitZ();  ///< unit, into the particles [-]
  Vec3 velocity = Vec3::Zero(); ///< [m/s]
  Vec3 force = Vec3::Zero();    ///< of the particles on the plane, out [N]
  double work = 0.;             ///< done by the plane on the particles, out [J]
  Vec3 impulse = Vec3::Zero();  ///< force over time, set to zero by its reader
                                ///< [N s]
  std::int64_t is_active = 1;   ///< 0: particles do not see it
};
} // namespace dem
