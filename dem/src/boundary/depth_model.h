#pragma once

#include "../contact/newton_step_control.h"

#include <dem/boundary/facet_surface.h>
#include <dem/contact/wall_contact_point.h>

#include <array>
#include <limits>

/// How deep the points about a contact point are in a particle, to second
/// order.
namespace dem
{
/// Hills of the depth over a face are trusted however flat.
inline constexpr NewtonStepControl facet_step_control{0.1, 80, least_curvature};

using Corners = std::array<Vec3, 3>;   ///< of a triangle [m]
using Weights = std::array<double, 3>; ///< barycentric [-]

inline Vec3 point_at(const Corners &corner, const Weights &weight)
{
  return weight[0] * corner[0] + weight[1] * corner[1] + weight[2] * corner[2];
}

/// The depth about a point y: D(y + z) = D(y) - n.z - z.C z / 2.
struct DepthModel
{
  Vec3 point, normal;
  Mat3 shape_operator; ///< C = K (I - delta K)^-1 [1/m]
  Mat3 follow;      ///< of the point of the particle: (I - delta K)^-1 across n
  Vec3 on_particle; ///< that point [m]
  Mat3 trusted;     ///< C as steps take it: the depth falls off all round
  double least = 0.;   ///< curvature that a step trusts [1/m]
  double longest = 0.; ///< largest step of the model [m]

  /// At a contact point of the particle with its depth.
  DepthModel(ParticleView &particle, const WallContactPoint &contact_point);

  /// Of depth, by a step from the point [m].
  double gain(const Vec3 &z) const
  {
    return -normal.dot(z) - 0.5 * z.dot(trusted * z);
  }
};

/// A point of a triangle that is to be deepest in it.
struct Ascent
{
  Weights weight{};
  Vec3 step = Vec3::Zero(); ///< from the point of the model [m]
  double gain = -std::numeric_limits<double>::infinity(); ///< of depth [m]
  bool is_summit = false; ///< the depth falls off to all sides on the face
};

/// The deepest point of the triangle by the model.
Ascent best_on_triangle(const DepthModel &model, const Corners &corner);
} // namespace dem
