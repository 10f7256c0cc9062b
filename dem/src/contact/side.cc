#include <dem/contact/side.h>
#include <dem/shape/measures.h>

#include <algorithm>
#include <cmath>

namespace dem
{
namespace
{
std::array<Narrow, 3> rounded(const Vec3 &v)
{
  return {static_cast<Narrow>(v.x()), static_cast<Narrow>(v.y()),
          static_cast<Narrow>(v.z())};
}

SurfaceSide sphere_side(const ParticleShape &body, const Vec3 &direction)
{
  SurfaceSide side;
  side.expansion.direction = direction;
  side.expansion.radius = mean_radius(body);
  side.curvature.first = side.curvature.second = 1. / side.expansion.radius;
  side.curvature.first_direction = rounded(direction.unitOrthogonal());
  return side;
}
} // namespace

SurfaceSide evaluate_side(const ParticleShape &body, const Vec3 &direction,
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
  const double floor = 1. / (floor_ratio * body.corner_radius);
  side.curvature = {std::max(kappa.maximum, floor),
                    std::max(kappa.minimum, floor),
                    rounded(kappa.max_direction),
                    is_corner(kappa.maximum, body.corner_radius)};
  return side;
}
} // namespace dem
