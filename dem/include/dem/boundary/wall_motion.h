#pragma once

#include <dem/vector.h>

#include <vector>

namespace dem
{
/// Motion of a rigid wall, which begins at a time and is at rest before. The
/// wall is displaced by
///   d(t) = v t + a sin(2 pi f t) + table(t)
/// and turns at a rate about an axis through a point that moves along. In its
/// free directions it is driven by forces instead, and so is its rotation if it
/// has a moment of inertia.
struct WallMotion
{
  double start = 0.;              ///< [s]
  Vec3 velocity = Vec3::Zero();   ///< v [m/s]
  Vec3 amplitude = Vec3::Zero();  ///< a [m]
  double frequency = 0.;          ///< f [Hz]
  std::vector<double> table_time; ///< since the start, rising [s]
  std::vector<Vec3> table_shift;  ///< linear between, constant beyond [m]
  Vec3 axis = Vec3::UnitZ();      ///< unit [-]
  Vec3 centre = Vec3::Zero();     ///< of the rotation, as placed [m]
  double spin = 0.;               ///< rate of rotation about the axis [rad/s]
  Vec3 free = Vec3::Zero();       ///< 1: driven along x, y, z; else 0 [-]
  double mass = 0.;               ///< of the wall where it is driven [kg]
  Vec3 force = Vec3::Zero();      ///< on it besides the particles' [N]
  /// Peak of a haversine at the frequency f, which is added to the force [N].
  Vec3 force_amplitude = Vec3::Zero();
  double largest_speed = 0.; ///< along a free direction; 0: any [m/s]
  double inertia = 0.;       ///< about the axis; 0: prescribed [kg m^2]
  double torque = 0.;        ///< besides that of the particles [N m]

  bool is_driven() const { return !free.isZero() || inertia > 0.; }
};

/// Load of the particles on a wall.
struct WallLoad
{
  Vec3 force = Vec3::Zero();  ///< [N]
  Vec3 moment = Vec3::Zero(); ///< about the centre of rotation now [N m]
};

/// Where a wall is. No byte of it is unused.
struct WallPose
{
  double time = 0.;             ///< since it was placed [s]
  Vec3 shift = Vec3::Zero();    ///< displacement [m]
  double angle = 0.;            ///< turned so far [rad]
  Vec3 velocity = Vec3::Zero(); ///< in the last step [m/s]
  double spin = 0.;             ///< in the last step [rad/s]
};

/// The displacement of a prescribed motion at a time since its start [m].
Vec3 prescribed_shift(const WallMotion &motion, double time);

/// Force on a driven wall besides that of the particles, at a time since the
/// start: F + A (1 - cos(2 pi f t)) / 2 [N].
Vec3 driving_force(const WallMotion &motion, double time);

/// The pose one step later. What is driven takes the velocity of the middle of
/// the step from the load at its beginning (velocity Verlet).
WallPose advanced(const WallMotion &motion, const WallPose &pose,
                  const WallLoad &load, double time_step);

/// Takes points of the wall as placed to where they are in a pose.
class WallTransform
{
public:
  WallTransform(const WallMotion &motion, const WallPose &pose);

  /// A point that has not turned keeps all its digits [m].
  Vec3 operator()(const Vec3 &placed) const
  {
    return is_turned ? Vec3(turn * (placed - centre) + centre + shift)
                     : Vec3(placed + shift);
  }

private:
  bool is_turned;
  Mat3 turn;
  Vec3 centre, shift; ///< [m]
};
} // namespace dem
