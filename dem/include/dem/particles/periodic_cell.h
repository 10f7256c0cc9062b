#pragma once

#include <dem/vector.h>

#include <cmath>

namespace dem
{
/// A box whose opposite faces are one along the chosen axes: a particle beyond
/// one face is in contact with those inside the other one. Positions are not
/// wrapped: a particle that leaves continues outside, and contacts are with the
/// nearest image, so that nothing jumps. Images move with the cell when its
/// lengths change.
struct PeriodicCell
{
  Vec3 centre = Vec3::Zero(); ///< [m]
  Vec3 length = Vec3::Zero(); ///< by axis; 0: not periodic [m]
  Vec3 rate = Vec3::Zero();   ///< of the lengths [m/s]
  /// Derivative of the work on the particles by each length: minus the
  /// compressive stress times the face [N].
  Vec3 force = Vec3::Zero();
  double work = 0.; ///< done on the particles by the change of length [J]

  bool is_there() const { return !length.isZero(0.); }
  bool is_periodic(int axis) const { return length[axis] > 0.; }

  /// How many lengths a branch vector spans along an axis, to the nearest image
  /// of its end.
  double images(int axis, double along) const
  {
    return is_periodic(axis) ? std::nearbyint(along / length[axis]) : 0.;
  }
  /// The branch vector to the nearest image.
  Vec3 nearest(const Vec3 &branch) const
  {
    Vec3 to_image = branch;
    for (int d = 0; d < 3; ++d)
      to_image[d] -= images(d, branch[d]) * length[d];
    return to_image;
  }
  /// Velocity of that image against the particle itself [m/s].
  Vec3 image_velocity(const Vec3 &branch) const
  {
    Vec3 velocity;
    for (int d = 0; d < 3; ++d)
      velocity[d] = -images(d, branch[d]) * rate[d];
    return velocity;
  }
  /// The image of a point that is inside of the cell.
  Vec3 wrapped(const Vec3 &point) const
  {
    return centre + nearest(point - centre);
  }
  /// Compressive stress on the faces of an axis, of this area [Pa].
  double stress(int axis, double face_area) const
  {
    return -force[axis] / face_area;
  }
};
} // namespace dem
