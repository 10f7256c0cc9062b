#include "damped_refinement.h"

#include <dem/contact/wall_contact_point.h>

#include <cmath>

namespace dem
{
// With d = x - y, delta = d.n and t the rest of d, the point of the surface
// next to y is a step a away with a - delta K a = -t.
WallContactPoint depth_of(ParticleView &particle, const Vec3 &point,
                          const Vec3 &on_particle)
{
  WallContactPoint contact_point;
  contact_point.point = point;
  contact_point.on_particle = on_particle;
  for (int step = 0; step < usual_step_control.most_steps; ++step)
  {
    const SurfacePoint &at = particle.at(contact_point.on_particle);
    const Vec3 apart = at.position - point;
    contact_point.normal = at.normal;
    contact_point.overlap = apart.dot(at.normal);
    const Frame frame = tangents(at.normal);
    const Vec2 aside = frame.transpose() * apart;
    if (aside.norm() < converged * particle.size())
    {
      contact_point.is_found = true;
      break;
    }
    const Mat2 shape_operator = frame.transpose() * at.shape_operator * frame;
    // Beyond the centre of curvature the nearest point is another one.
    const Mat2 system =
        floored(Mat2::Identity() - contact_point.overlap * shape_operator,
                lowest_curvature);
    const Vec3 along = frame * Vec2(-(system.inverse() * aside));
    contact_point.on_particle = particle.towards(
        at.position +
        shortened(along, usual_step_control.longest_step * particle.size()));
  }
  return contact_point;
}

bool is_one_patch(const Vec3 &normal, const Vec3 &other)
{
  return normal.dot(other) > std::sqrt(0.5);
}
} // namespace dem
