#pragma once

#include <dem/vector.h>

#include <cstdint>

namespace dem
{
/// Smooth parts of a drum; a particle may touch each of them once.
enum class DrumPart : std::int32_t
{
  cylinder,
  lower_end, ///< against the axis
  upper_end,
  lifter
};
inline constexpr std::int32_t n_drum_parts = 4;

/// A drum that turns about its axis, with particles inside: a cylinder, two end
/// plates, and a lifter along the whole length that stands into it. The lifter
/// points up at angle zero, along x if the axis is vertical. The cylinder may
/// widen if it has no lifter. Radius zero: there is no drum.
struct Drum
{
  Vec3 centre = Vec3::Zero();   ///< middle of the axis [m]
  Vec3 axis = Vec3::UnitY();    ///< unit [-]
  double radius = 0.;           ///< inner [m]
  double length = 0.;           ///< inner [m]
  double lifter_height = 0.;    ///< from the cylinder inwards; 0: none [m]
  double lifter_thickness = 0.; ///< [m]
  double spin = 0.;             ///< about the axis [rad/s]
  double widening = 0.;         ///< of the radius [m/s]
  double angle = 0.;            ///< turned so far, out [rad]
  double torque = 0.;           ///< of the particles about the axis, out [N m]
  double thrust = 0.; ///< of the particles, outward on the side, out [N]
  double work = 0.;   ///< done by the drum on the particles, out [J]

  bool is_there() const { return radius > 0.; }
  /// Of a part of the drum at a point [m/s].
  Vec3 velocity_at(DrumPart part, const Vec3 &point) const;
};

/// Towards the root of the lifter as it stands, across the axis.
Vec3 lifter_direction(const Drum &drum);

/// Nearest point of a part of the drum to a point inside.
struct DrumPoint
{
  Vec3 point = Vec3::Zero();   ///< nearest of the part [m]
  Vec3 normal = Vec3::UnitX(); ///< unit, towards the part [-]
  double distance = 0.;        ///< along the normal; negative inside [m]
};

/// On the axis the cylinder is above. Edges of the lifter are round to the
/// particles: the normal goes to the nearest point.
DrumPoint nearest_on_drum(const Drum &drum, DrumPart part, const Vec3 &x);
} // namespace dem
