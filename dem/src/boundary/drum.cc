#include <dem/assert.h>
#include <dem/boundary/drum.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace dem
{
namespace
{
DrumPoint on_cylinder(const Drum &drum, const Vec3 &from_axis, const Vec3 &x)
{
  const double distance = from_axis.norm();
  DrumPoint at;
  at.normal =
      distance > 0. ? Vec3(from_axis / distance) : lifter_direction(drum);
  at.distance = drum.radius - distance;
  at.point = x + at.distance * at.normal;
  return at;
}

DrumPoint on_end(const Drum &drum, double along, double side, const Vec3 &x)
{
  DrumPoint at;
  at.normal = side * drum.axis;
  at.distance = 0.5 * drum.length - side * along;
  at.point = x + at.distance * at.normal;
  return at;
}

/// The lifter is a bar of rectangular section: from radius - height outwards,
/// half the thickness to either side.
DrumPoint on_lifter(const Drum &drum, const Vec3 &from_axis, const Vec3 &x)
{
  DrumPoint at;
  if (drum.lifter_height <= 0.)
  {
    at.distance = std::numeric_limits<double>::max();
    return at;
  }
  const Vec3 out = lifter_direction(drum), side = drum.axis.cross(out);
  const double u = from_axis.dot(out), v = from_axis.dot(side);
  const double tip = drum.radius - drum.lifter_height,
               half = 0.5 * drum.lifter_thickness;
  const double du = std::max(tip - u, 0.), dv = std::clamp(v, -half, half) - v;
  at.distance = std::hypot(du, dv);
  if (at.distance > 0.)
  {
    at.normal = (du * out + dv * side) / at.distance;
    at.point = x + du * out + dv * side;
    return at;
  }
  // The centre is inside: out by the nearest face.
  const double to_tip = u - tip, to_face = half - std::abs(v);
  at.distance = -std::min(to_tip, to_face);
  at.normal = to_tip < to_face ? out : Vec3(v > 0. ? -side : side);
  at.point = x + at.distance * at.normal;
  return at;
}
} // namespace

Vec3 lifter_direction(const Drum &drum)
{
  const Vec3 across = Vec3::UnitZ() - drum.axis.z() * drum.axis;
  const Vec3 up = across.norm() > 1e-9 ? across.normalized() : Vec3::UnitX();
  return std::cos(drum.angle) * up + std::sin(drum.angle) * drum.axis.cross(up);
}

Vec3 Drum::velocity_at(DrumPart part, const Vec3 &point) const
{
  const Vec3 arm = point - centre;
  const Vec3 turning = spin * axis.cross(arm);
  if (widening == 0. || part != DrumPart::cylinder)
    return turning;
  const Vec3 across = arm - arm.dot(axis) * axis;
  const double distance = across.norm();
  return distance > 0. ? Vec3(turning + (widening / distance) * across)
                       : turning;
}

DrumPoint nearest_on_drum(const Drum &drum, DrumPart part, const Vec3 &x)
{
  DEM_ASSERT(drum.is_there());
  const Vec3 from_centre = x - drum.centre;
  const double along = from_centre.dot(drum.axis);
  const Vec3 from_axis = from_centre - along * drum.axis;
  switch (part)
  {
  case DrumPart::cylinder:
    return on_cylinder(drum, from_axis, x);
  case DrumPart::lower_end:
    return on_end(drum, along, -1., x);
  case DrumPart::upper_end:
    return on_end(drum, along, 1., x);
  case DrumPart::lifter:
    break;
  }
  return on_lifter(drum, from_axis, x);
}
} // namespace dem
