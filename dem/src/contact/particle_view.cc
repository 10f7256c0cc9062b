#include <dem/contact/particle_view.h>

namespace dem
{
namespace
{
/// w of the paraboloid where a direction meets it, if it holds there: no
/// farther from the vertex than this part of the height.
std::optional<Vec3> offset_within(const std::optional<Paraboloid> &known,
                                  const Vec3 &direction, double tolerance)
{
  if (!known || direction.dot(known->vertex.normal) <= 0.)
    return {};
  const Vec3 w = known->offset_towards(direction);
  const double reach = tolerance * known->height();
  return w.squaredNorm() <= reach * reach ? std::optional(w) : std::nullopt;
}
} // namespace

ParticleView::ParticleView(const ParticleShape &seen, const Vec3 &at,
                           const Mat3 &turned_by, double reach)
    : body(seen), position(at), rotation(turned_by), tolerance(reach),
      mean_size(mean_radius(seen))
{
}

void ParticleView::start_from(const Paraboloid &paraboloid)
{
  known = paraboloid;
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
  const std::optional<Vec3> w = offset_within(known, direction, tolerance);
  const SurfacePoint on_body =
      w ? known->at(*w) : surface_point(body, direction);
  if (!w && body.series)
  {
    known = Paraboloid{on_body};
    has_renewed = true;
  }
  last = turned(on_body, rotation);
  last.position += position;
  last_direction = direction;
  return last;
}
} // namespace dem
