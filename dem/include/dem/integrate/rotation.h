#pragma once

#include <dem/vector.h>

namespace dem
{
/// exp(rotation vector) as a unit quaternion; the vector in [rad].
Quaternion exponential(const Vec3 &rotation);

/// A rigid body that turns freely, in its principal frame.
struct Rotor
{
  Vec3 moments = Vec3::Ones();                  ///< principal, > 0 [kg m^2]
  Quaternion to_world = Quaternion::Identity(); ///< principal frame to world
  Vec3 spin = Vec3::Zero();                     ///< world frame [rad/s]
};

/// Turns it without a moment over `time_step` [s]: rotations about the three
/// principal axes in turn, half ones before and after the third. Symplectic, of
/// second order; the angular momentum is kept to round-off, the energy error
/// does not grow (Touma & Wisdom 1994, Dullweber et al. 1997).
void turn_freely(Rotor &rotor, double time_step);
} // namespace dem
