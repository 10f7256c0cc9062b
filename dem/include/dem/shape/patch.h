#pragma once

#include <dem/shape/spherical_harmonics.h>

namespace dem
{
/// Principal curvatures of the surface x = r(s) s, positive where convex.
struct PrincipalCurvatures
{
  double maximum = 0.;                ///< kappa_max, algebraic order [1/m]
  double minimum = 0.;                ///< kappa_min [1/m]
  Vec3 max_direction = Vec3::UnitX(); ///< tangent direction of maximum [-]
  Vec3 normal = Vec3::UnitZ();        ///< outward surface normal [-]
};

/// From the first and second fundamental forms of x = r(s) s: eigenvalues of
/// I^-1 II with I_ij = r^2 d_ij + r_i r_j,
/// II_ij = (r^2 d_ij + 2 r_i r_j - r r_ij) / sqrt(r^2 + |grad r|^2).
PrincipalCurvatures principal_curvatures(const RadialExpansion &expansion);
} // namespace dem
