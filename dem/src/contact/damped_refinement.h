#pragma once

#include "newton_step_control.h"

#include <dem/shape/particle_shape.h>
#include <dem/shape/spherical_harmonics.h>

#include <cmath>

namespace dem
{
/// A function of space to second order at a point.
struct LocalField
{
  double value = 0.;
  Vec3 gradient = Vec3::Zero();
  Mat3 hessian = Mat3::Zero();
};

/// Where a refinement over the surface of a particle has ended.
struct Summit
{
  Vec3 direction = Vec3::UnitZ(); ///< unit, body frame [-]
  double value = 0.;              ///< of the field there
  bool is_found = false;          ///< the refinement has converged to a maximum
};

/// r and its derivatives with the scale of the body applied.
inline RadialExpansion scaled_expansion(const ParticleShape &body,
                                        const Vec3 &direction)
{
  if (!body.series)
  {
    RadialExpansion sphere;
    sphere.direction = direction;
    sphere.radius = body.scale;
    return sphere;
  }
  RadialExpansion at = expand(*body.series, direction);
  at.radius *= body.scale;
  at.gradient *= body.scale;
  at.hessian *= body.scale;
  return at;
}

/// Refines over the directions to a maximum of field(x), x = r(s) s in the body
/// frame, and never steps down: Newton steps with the Hessian made negative,
/// halved until the field grows. For starts from which the quick refinements
/// over tangent planes do not arrive, such as beside the tip of a needle.
template <class Field>
Summit refine_damped(const ParticleShape &body, const Vec3 &start,
                     const Field &field)
{
  constexpr int most_steps = 200, most_halvings = 30;
  constexpr double longest = 0.1, level = 1e-9; // [rad]
  constexpr double level_hill = 0.1; // of the least curvature that steps trust
  RadialExpansion at = scaled_expansion(body, start);
  LocalField now = field(Vec3(at.radius * start));
  Summit summit{start, now.value, false};
  if (!std::isfinite(now.value))
    return summit;
  for (int step = 0; step < most_steps; ++step)
  {
    const Frame frame = tangents(summit.direction);
    const Vec2 slope = frame.transpose() * at.gradient,
               across = frame.transpose() * now.gradient;
    const double along = now.gradient.dot(summit.direction);
    // dx = J w + s w.H w / 2 + ... with J = s g^T + r T.
    const Eigen::Matrix<double, 3, 2> jacobian =
        summit.direction * slope.transpose() + at.radius * frame;
    const Vec2 gradient = jacobian.transpose() * now.gradient;
    const Mat2 hessian = jacobian.transpose() * now.hessian * jacobian +
                         along * (frame.transpose() * at.hessian * frame -
                                  at.radius * Mat2::Identity()) +
                         slope * across.transpose() +
                         across * slope.transpose();
    const Mat2 hill = -0.5 * (hessian + hessian.transpose());
    const double least = 1e-3 * at.radius * now.gradient.norm();
    Vec2 move = floored(hill, least).inverse() * gradient;
    if (const double length = move.norm(); length > longest)
      move *= longest / length;
    // A ring of equal maxima is level along itself, but for round-off.
    const bool is_hill = smallest_eigenvalue(hill) > -level_hill * least;
    const double rise = gradient.dot(move); // twice what the step promises
    if (move.norm() < level)
    {
      summit.is_found = is_hill;
      return summit;
    }
    bool is_higher = false;
    for (int halving = 0; halving < most_halvings && !is_higher; ++halving)
    {
      const Vec3 to = (summit.direction + frame * move).normalized();
      const RadialExpansion there = scaled_expansion(body, to);
      const LocalField then = field(Vec3(there.radius * to));
      is_higher = then.value > summit.value;
      if (is_higher)
      {
        at = there;
        now = then;
        summit.direction = to;
        summit.value = then.value;
      }
      move *= 0.5;
    }
    // Flat hills, and rings that lean by a hair, are climbed by many steps: so
    // near to the top no height is left.
    summit.is_found = is_hill && rise < 1e-9 * at.radius * now.gradient.norm();
    if (!is_higher) // round-off is all that is left
      return summit;
  }
  return summit;
}
} // namespace dem
