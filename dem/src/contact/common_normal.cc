#include "damped_refinement.h"

#include <dem/contact/common_normal.h>
#include <dem/contact/wall_contact_point.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace dem
{
SurfacePoint surface_point(const ParticleShape &body, const Vec3 &direction)
{
  if (body.series)
    return surface_point(scaled_expansion(body, direction));
  SurfacePoint point;
  point.position = body.scale * direction;
  point.normal = direction;
  point.shape_operator =
      (Mat3::Identity() - direction * direction.transpose()) / body.scale;
  return point;
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
  point.shape_operator = across * hessian * across / steepness;
  return point;
}

NormalStep step_to_common_normal(const SurfacePoint &a, const SurfacePoint &b,
                                 double size, const NewtonStepControl &control)
{
  const Frame frame = tangents(a.normal);
  const Vec3 d = a.position - b.position;
  const double overlap = d.dot(a.normal);
  const Vec2 t = frame.transpose() * d, m = frame.transpose() * b.normal;
  const Mat2 shape_operator_a = frame.transpose() * a.shape_operator * frame;
  const Mat2 shape_operator_b = frame.transpose() * b.shape_operator * frame;
  const Mat2 lens = shape_operator_a + shape_operator_b;
  const Mat2 beyond = overlap * shape_operator_b * shape_operator_a;
  NormalStep steps;
  steps.is_lens = lens.trace() > 0. && (lens - beyond).determinant() > 0.;
  const Mat2 system = control.trusted(lens, size) - beyond;
  const Vec2 along_a = system.partialPivLu().solve(-m - shape_operator_b * t);
  const Vec2 along_b = along_a - overlap * shape_operator_a * along_a + t;
  steps.on_a = frame * along_a;
  steps.on_b = frame * along_b;
  const Vec2 across = along_a + t;
  steps.overlap = overlap - 0.5 * along_a.dot(shape_operator_a * along_a) -
                  m.dot(across) - 0.5 * across.dot(shape_operator_b * across);
  return steps;
}

SurfacePoint turned(const SurfacePoint &point, const Mat3 &rotation)
{
  return {rotation * point.position, rotation * point.normal,
          rotation * point.shape_operator * rotation.transpose()};
}

namespace
{
/// What counts as less deep than the start, of the radius: such a refinement
/// has gone down, over to another contact point.
constexpr double surely_less = 1e-6;

ContactPoint refine(const ParticleShape &a, const ParticleShape &b,
                    const RelativePose &pose, const ContactPoint &start,
                    const NewtonStepControl &control)
{
  const double size = std::min(mean_radius(a), mean_radius(b));
  double first_apart = 0.;
  ContactPoint contact_point = start;
  contact_point.is_found = false;
  for (int step = 0; step < control.most_steps && !contact_point.is_found;
       ++step)
  {
    const SurfacePoint on_a = surface_point(a, contact_point.on_a);
    SurfacePoint on_b =
        turned(surface_point(b, contact_point.on_b), pose.rotation);
    on_b.position += pose.position;
    if (step == 0)
      first_apart = (on_b.position - on_a.position).norm();
    const NormalStep newton = step_to_common_normal(on_a, on_b, size, control);
    const Vec3 along_a = shortened(newton.on_a, control.longest_step * size);
    const Vec3 along_b = shortened(newton.on_b, control.longest_step * size);
    contact_point.on_a = (on_a.position + along_a).normalized();
    contact_point.on_b =
        (pose.rotation.transpose() * (on_b.position + along_b - pose.position))
            .normalized();
    contact_point.overlap = newton.overlap;
    contact_point.is_found =
        newton.is_lens &&
        newton.on_a.norm() + newton.on_b.norm() < converged * size;
  }
  if (contact_point.overlap < -first_apart - surely_less * size)
    contact_point.is_found = false;
  return contact_point;
}
} // namespace

namespace
{
/// How deep a point in the body frame of A is in B, from the direction that the
/// last point ended at.
class DepthInB
{
public:
  DepthInB(const ParticleShape &b, const RelativePose &pose, const Vec3 &start)
      : particle(b, pose.position, pose.rotation, 0.), on_b(start)
  {
  }

  LocalField operator()(const Vec3 &x)
  {
    const WallContactPoint contact_point = depth_of(particle, x, on_b);
    if (!contact_point.is_found)
      return {-std::numeric_limits<double>::infinity(), Vec3::Zero(),
              Mat3::Zero()};
    on_b = contact_point.on_particle;
    // D(y) with grad D = -n and -grad grad D = K (I - D K)^-1.
    const Frame frame = tangents(contact_point.normal);
    const Mat2 shape_operator =
        frame.transpose() * particle.at(on_b).shape_operator * frame;
    const Mat2 depth =
        shape_operator *
        floored(Mat2::Identity() - contact_point.overlap * shape_operator,
                lowest_curvature)
            .inverse();
    return {contact_point.overlap, -contact_point.normal,
            -(frame * (0.5 * (depth + depth.transpose())) * frame.transpose())};
  }

  const Vec3 &foot() const { return on_b; }

private:
  ParticleView particle;
  Vec3 on_b;
};

/// The point of A that is deepest in B among its neighbours.
ContactPoint deepest_point(const ParticleShape &a, const ParticleShape &b,
                           const RelativePose &pose, const ContactPoint &start)
{
  DepthInB depth(b, pose, start.on_b);
  const Summit top = refine_damped(
      a, start.on_a, [&depth](const Vec3 &x) { return depth(x); });
  ContactPoint contact_point{top.direction, start.on_b, top.value,
                             top.is_found};
  if (top.is_found)
  {
    // The last look need not have been at the summit.
    depth(scaled_expansion(a, top.direction).radius * top.direction);
    contact_point.on_b = depth.foot();
  }
  return contact_point;
}
} // namespace

ContactPoint refine(const ParticleShape &a, const ParticleShape &b,
                    const RelativePose &pose, const ContactPoint &start)
{
  ContactPoint contact_point = refine(a, b, pose, start, usual_step_control);
  for (const NewtonStepControl &control :
       {careful_step_control, flat_step_control})
    if (!contact_point.is_found)
      contact_point = refine(a, b, pose, start, control);
  if (contact_point.is_found)
    return contact_point;
  const ContactPoint deepest = deepest_point(a, b, pose, start);
  return deepest.is_found ? deepest : contact_point;
}

namespace
{
Support refine_along(const ParticleShape &body, const Vec3 &normal,
                     const Vec3 &start, const NewtonStepControl &control)
{
  double first_height = 0.;
  const double size = mean_radius(body);
  const Frame frame = tangents(normal);
  Support support;
  support.direction = start;
  for (int step = 0; step < control.most_steps && !support.is_found; ++step)
  {
    const SurfacePoint at = surface_point(body, support.direction);
    const Mat2 shape_operator = frame.transpose() * at.shape_operator * frame;
    const Vec2 along = control.trusted(shape_operator, size)
                           .llt()
                           .solve(-frame.transpose() * at.normal);
    const Vec3 ascent = shortened(frame * along, control.longest_step * size);
    support.direction = (at.position + ascent).normalized();
    if (step == 0)
      first_height = at.position.dot(normal);
    support.height =
        at.position.dot(normal) + 0.5 * along.dot(shape_operator * along);
    support.is_found =
        shape_operator.trace() > 0. && shape_operator.determinant() > 0. &&
        at.normal.dot(normal) > 0. && along.norm() < converged * size;
  }
  if (support.height < first_height - surely_less * size)
    support.is_found = false;
  return support;
}
} // namespace

Support find_support(const ParticleShape &body, const Vec3 &normal,
                     const Vec3 &start)
{
  for (const NewtonStepControl &control :
       {usual_step_control, flat_step_control})
    if (const Support support = refine_along(body, normal, start, control);
        support.is_found)
      return support;
  const Summit top =
      refine_damped(body, start,
                    [&normal](const Vec3 &x) {
                      return LocalField{x.dot(normal), normal, Mat3::Zero()};
                    });
  return {top.direction, top.value, top.is_found};
}
} // namespace dem
