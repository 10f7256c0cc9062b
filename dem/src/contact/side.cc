#include <dem/contact/side.h>
#include <dem/shape/measures.h>

#include <algorithm>
#include <cmath>

namespace dem
{
namespace
{
SurfaceSide sphere_side(const Body &body, const Vec3 &direction)
{
  SurfaceSide side;
  side.expansion.direction = direction;
  side.expansion.radius = mean_radius(body);
  side.first_curvature = side.second_curvature = 1. / side.expansion.radius;
  side.first_direction = direction.unitOrthogonal();
  side.is_known = true;
  return side;
}
} // namespace

SurfaceSide evaluate_side(const Body &body, const Vec3 &direction,
                          double floor_ratio)
{
  if (!body.series)
    return sphere_side(body, direction);
  SurfaceSide side;
  side.expansion = expand(*body.series, direction);
  side.expansion.radius *= body.scale;
  side.expansion.gradient *= body.scale;
  side.expansion.hessian *= body.scale;
  const PrincipalCurvatures kappa = principal_curvatures(side.expansion);
  const double floor = 1. / (floor_ratio * body.inscribed_radius);
  side.first_curvature = std::max(kappa.maximum, floor);
  side.second_curvature = std::max(kappa.minimum, floor);
  side.first_direction = kappa.max_direction;
  side.is_corner = is_corner(kappa.maximum, body.inscribed_radius);
  side.is_known = true;
  return side;
}
} // namespace dem
