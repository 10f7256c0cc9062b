#include "pace.h"

#include <dem/contact/common_normal.h>

#include <algorithm>
#include <cmath>

namespace dem
{
SurfacePoint surface_point(const Body &body, const Vec3 &direction)
{
  SurfacePoint point;
  if (!body.series)
  {
    point.position = body.scale * direction;
    point.normal = direction;
    point.bend =
        (Mat3::Identity() - direction * direction.transpose()) / body.scale;
    return point;
  }
  RadialExpansion at = expand(*body.series, direction);
  at.radius *= body.scale;
  at.gradient *= body.scale;
  at.hessian *= body.scale;
  return surface_point(at);
}

SurfacePoint surface_point(const RadialExpansion &at)
{
  const double r = at.radius;
  const Vec3 &s = at.direction, &g = at.gradient;
  // F(x) = |x| - r(x / |x|): its gradient and Hessian at the surface.
  const Vec3 slope = s - g / r;
  const Mat3 mixed = s * g.transpose();
  const Mat3 hessian = (Mat3::Identity() - s * s.transpose()) / r -
                       (at.hessian - mixed - mixed.transpose()) / (r * r);
  const double steepness = slope.norm();
  SurfacePoint point;
  point.position = r * s;
  point.normal = slope / steepness;
  const Mat3 across =
      Mat3::Identity() - point.normal * point.normal.transpose();
  point.bend = across * hessian * across / steepness;
  return point;
}

NormalStep step_to_common_normal(const SurfacePoint &a, const SurfacePoint &b,
                                 double size, const Pace &pace)
{
  const Frame frame = tangents(a.normal);
  const Vec3 d = a.position - b.position;
  const double overlap = d.dot(a.normal);
  const Vec2 t = frame.transpose() * d, m = frame.transpose() * b.normal;
  const Mat2 bend_a = frame.transpose() * a.bend * frame;
  const Mat2 bend_b = frame.transpose() * b.bend * frame;
  const Mat2 lens = bend_a + bend_b;
  NormalStep steps;
  steps.is_lens = lens.trace() > 0. && lens.determinant() > 0.;
  const Mat2 system = pace.trusted(lens, size) - overlap * bend_b * bend_a;
  const Vec2 along_a = system.partialPivLu().solve(-m - bend_b * t);
  const Vec2 along_b = along_a - overlap * bend_a * along_a + t;
  steps.on_a = frame * along_a;
  steps.on_b = frame * along_b;
  const Vec2 across = along_a + t;
  steps.overlap = overlap - 0.5 * along_a.dot(bend_a * along_a) -
                  m.dot(across) - 0.5 * across.dot(bend_b * across);
  return steps;
}

SurfacePoint turned(const SurfacePoint &point, const Mat3 &rotation)
{
  return {rotation * point.position, rotation * point.normal,
          rotation * point.bend * rotation.transpose()};
}

namespace
{
Spot climb(const Body &a, const Body &b, const RelativePose &pose,
           const Spot &start, const Pace &pace)
{
  const double size = std::min(mean_radius(a), mean_radius(b));
  Spot spot = start;
  spot.is_found = false;
  for (int step = 0; step < pace.most_steps && !spot.is_found; ++step)
  {
    const SurfacePoint on_a = surface_point(a, spot.on_a);
    SurfacePoint on_b = turned(surface_point(b, spot.on_b), pose.rotation);
    on_b.position += pose.position;
    const NormalStep newton = step_to_common_normal(on_a, on_b, size, pace);
    const Vec3 along_a = shortened(newton.on_a, pace.longest_step * size);
    const Vec3 along_b = shortened(newton.on_b, pace.longest_step * size);
    spot.on_a = (on_a.position + along_a).normalized();
    spot.on_b =
        (pose.rotation.transpose() * (on_b.position + along_b - pose.position))
            .normalized();
    spot.overlap = newton.overlap;
    spot.is_found = newton.is_lens &&
                    newton.on_a.norm() + newton.on_b.norm() < converged * size;
  }
  return spot;
}
} // namespace

Spot polish(const Body &a, const Body &b, const RelativePose &pose,
            const Spot &start)
{
  Spot spot = climb(a, b, pose, start, usual_pace);
  for (const Pace &pace : {careful_pace, flat_pace})
    if (!spot.is_found)
      spot = climb(a, b, pose, start, pace);
  return spot;
}

namespace
{
Support climb_along(const Body &body, const Vec3 &normal, const Vec3 &start,
                    const Pace &pace)
{
  const double size = mean_radius(body);
  const Frame frame = tangents(normal);
  Support support;
  support.direction = start;
  for (int step = 0; step < pace.most_steps && !support.is_found; ++step)
  {
    const SurfacePoint at = surface_point(body, support.direction);
    const Mat2 bend = frame.transpose() * at.bend * frame;
    const Vec2 along =
        pace.trusted(bend, size).llt().solve(-frame.transpose() * at.normal);
    const Vec3 climb = shortened(frame * along, pace.longest_step * size);
    support.direction = (at.position + climb).normalized();
    support.height = at.position.dot(normal) + 0.5 * along.dot(bend * along);
    support.is_found = bend.trace() > 0. && bend.determinant() > 0. &&
                       at.normal.dot(normal) > 0. &&
                       along.norm() < converged * size;
  }
  return support;
}
} // namespace

Support find_support(const Body &body, const Vec3 &normal, const Vec3 &start)
{
  const Support support = climb_along(body, normal, start, usual_pace);
  return support.is_found ? support
                          : climb_along(body, normal, start, flat_pace);
}
} // namespace dem
