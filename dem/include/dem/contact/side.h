#pragma once

#include <dem/contact/material.h>
#include <dem/shape/body.h>
#include <dem/shape/patch.h>

namespace dem
{
/// What a contact remembers of the surface of one of its stones: the
/// second-order expansion of r about one body direction and the curvatures
/// there (MODEL 11.2).
struct SurfaceSide
{
  RadialExpansion expansion;            ///< scale applied
  double first_curvature = 0.;          ///< kappa_max, floored [1/m]
  double second_curvature = 0.;         ///< kappa_min, floored [1/m]
  Vec3 first_direction = Vec3::UnitX(); ///< of kappa_max, body frame [-]
  bool is_known = false;                ///< false: evaluate before use
  bool is_corner = false;               ///< g = 1 (Eq. 14, unfloored)

  double gaussian_curvature() const
  {
    return first_curvature * second_curvature;
  }
};

/// Series and curvatures of the stone at a unit direction of its body frame;
/// both curvatures are floored at 1 / (floor_ratio r_ins) (MODEL 7.2).
SurfaceSide evaluate_side(const Body &body, const Vec3 &direction,
                          double floor_ratio);

/// r at `direction` from the cached expansion [m].
inline double cached_radius(const SurfaceSide &side, const Vec3 &direction)
{
  const RadialExpansion &e = side.expansion;
  const Vec3 w = direction - e.direction;
  return e.radius + e.gradient.dot(w) + 0.5 * w.dot(e.hessian * w);
}

/// True where the expansion no longer holds for `direction`.
inline bool is_stale(const SurfaceSide &side, const Vec3 &direction,
                     double tolerance)
{
  return !side.is_known ||
         (direction - side.expansion.direction).squaredNorm() >
             tolerance * tolerance;
}
} // namespace dem
