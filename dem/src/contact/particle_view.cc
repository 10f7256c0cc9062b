#include <dem/contact/particle_view.h>

namespace dem
{
namespace
{
/// s / (s.u) - u: where the ray along s meets the plane that touches the sphere
/// at u.
Vec3 offset_from(const Vec3 &u, const Vec3 &s)
{
  return s / s.dot(u) - u;
}

/// r and its derivatives at s beside the direction u of `from`, of the surface
/// r = r_u + g.w + w.H w / 2 with the offset w: value and gradient exactly, so
/// that normals are those of one smooth surface.
RadialExpansion moved(const RadialExpansion &from, const Vec3 &s)
{
  const Vec3 &u = from.direction;
  const Vec3 w = offset_from(u, s);
  const Vec3 bent = from.hessian * w, slope = from.gradient + bent;
  const double cosine = s.dot(u);
  RadialExpansion at;
  at.direction = s;
  at.radius = from.radius + from.gradient.dot(w) + 0.5 * w.dot(bent);
  at.gradient = (slope - (slope.dot(s) / cosine) * u) / cosine;
  const Mat3 across = Mat3::Identity() - s * s.transpose();
  at.hessian = across * from.hessian * across;
  return at;
}
} // namespace

ParticleView::ParticleView(const ParticleShape &seen, const Vec3 &at,
                           const Mat3 &turned_by, double reach)
    : body(seen), position(at), rotation(turned_by), tolerance(reach),
      mean_size(mean_radius(seen))
{
}

void ParticleView::start_from(const RadialExpansion &expansion)
{
  known = expansion;
  has_renewed = false;
  last_direction = Vec3::Zero();
}

Vec3 ParticleView::towards(const Vec3 &point) const
{
  return (rotation.transpose() * (point - position)).normalized();
}

const SurfacePoint &ParticleView::at(const Vec3 &direction)
{
  if (direction == last_direction)
    return last;
  const bool is_near = known.radius > 0. &&
                       direction.dot(known.direction) > 0. &&
                       offset_from(known.direction, direction).squaredNorm() <=
                           tolerance * tolerance;
  if (!is_near && body.series)
  {
    known = expand(*body.series, direction);
    known.radius *= body.scale;
    known.gradient *= body.scale;
    known.hessian *= body.scale;
    has_renewed = true;
  }
  last = turned(!body.series ? surface_point(body, direction)
                : is_near    ? surface_point(moved(known, direction))
                             : surface_point(known),
                rotation);
  last.position += position;
  last_direction = direction;
  return last;
}
} // namespace dem
