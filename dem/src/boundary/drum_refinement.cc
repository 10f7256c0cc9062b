#include "../contact/damped_refinement.h"

#include <dem/boundary/wall_refinement.h>

namespace dem
{
namespace
{
Vec3 out_of_axis(const Drum &drum, const Vec3 &x)
{
  const Vec3 from_centre = x - drum.centre;
  return from_centre - from_centre.dot(drum.axis) * drum.axis;
}
} // namespace

SurfacePoint smooth_drum(const Drum &drum, DrumPart part, const Vec3 &x)
{
  const DrumPoint at = nearest_on_drum(drum, part, x);
  SurfacePoint wall;
  wall.position = at.point;
  wall.normal = -at.normal;
  if (part == DrumPart::cylinder)
  {
    // Hollow: the normal turns against the motion.
    const Vec3 round = drum.axis.cross(at.normal);
    wall.shape_operator = -(round * round.transpose()) / drum.radius;
  }
  return wall;
}

namespace
{
/// What counts as less deep than the start, of the radius: more than two
/// expansions of a surface differ by.
constexpr double surely_less = 1e-4;

WallContactPoint refine_at(const NewtonStepControl &control,
                           ParticleView &particle, const Drum &drum,
                           DrumPart part, const WallContactPoint &start)
{
  WallContactPoint contact_point = start;
  contact_point.is_found = false;
  double first_overlap = 0.;
  for (int step = 0; step < control.most_steps && !contact_point.is_found;
       ++step)
  {
    const SurfacePoint &at = particle.at(contact_point.on_particle);
    if (part == DrumPart::cylinder &&
        out_of_axis(drum, at.position).norm() < 0.1 * drum.radius)
      break; // no side of the cylinder is nearer than another
    const SurfacePoint wall = smooth_drum(drum, part, at.position);
    const NormalStep newton =
        step_to_common_normal(at, wall, particle.size(), control);
    contact_point.normal = -wall.normal;
    contact_point.point = wall.position;
    contact_point.overlap =
        (at.position - wall.position).dot(contact_point.normal);
    if (step == 0)
      first_overlap = contact_point.overlap;
    contact_point.is_found = newton.is_lens &&
                             newton.on_a.norm() < converged * particle.size() &&
                             at.normal.dot(contact_point.normal) > 0.;
    if (!contact_point.is_found)
      contact_point.on_particle = particle.towards(
          at.position +
          shortened(newton.on_a, control.longest_step * particle.size()));
  }
  // The overlap decreased: another contact point.
  if (contact_point.overlap < first_overlap - surely_less * particle.size())
    contact_point.is_found = false;
  return contact_point;
}

/// The same without a step down, on the series.
WallContactPoint refine_on_drum_damped(const ParticleView &particle,
                                       const Drum &drum, DrumPart part,
                                       const WallContactPoint &start)
{
  const Mat3 back = particle.orientation().transpose();
  const auto depth = [&](const Vec3 &x)
  {
    const DrumPoint at = nearest_on_drum(drum, part, particle.in_world(x));
    LocalField field{-at.distance, back * at.normal, Mat3::Zero()};
    if (part == DrumPart::cylinder)
    {
      // The distance from the axis is curved round it.
      const Vec3 round = back * drum.axis.cross(at.normal);
      field.hessian = round * round.transpose() /
                      std::max(drum.radius - at.distance, 0.1 * drum.radius);
    }
    return field;
  };
  const Summit top = refine_damped(particle.shape(), start.on_particle, depth);
  WallContactPoint contact_point = start;
  contact_point.on_particle = top.direction;
  const double radius =
      scaled_expansion(particle.shape(), top.direction).radius;
  const DrumPoint at =
      nearest_on_drum(drum, part, particle.in_world(radius * top.direction));
  contact_point.normal = at.normal;
  contact_point.point = at.point;
  contact_point.overlap = -at.distance;
  contact_point.is_found = top.is_found && (part != DrumPart::cylinder ||
                                            at.distance < 0.9 * drum.radius);
  return contact_point;
}
} // namespace

WallContactPoint refine_on_drum(ParticleView &particle, const Drum &drum,
                                DrumPart part, const WallContactPoint &start)
{
  for (const NewtonStepControl &control :
       {usual_step_control, flat_step_control})
    if (const WallContactPoint contact_point =
            refine_at(control, particle, drum, part, start);
        contact_point.is_found)
      return contact_point;
  return refine_on_drum_damped(particle, drum, part, start);
}
} // namespace dem
