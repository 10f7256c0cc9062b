#include <dem/binary.h>
#include <dem/boundary/mesh_wall.h>

#include <algorithm>
#include <utility>

namespace dem
{
namespace
{
template <class Motion, class Visit>
void visit_numbers(Motion &motion, const Visit &visit)
{
  visit(motion.start);
  visit(motion.velocity);
  visit(motion.amplitude);
  visit(motion.frequency);
  visit(motion.axis);
  visit(motion.centre);
  visit(motion.spin);
  visit(motion.free);
  visit(motion.mass);
  visit(motion.force);
  visit(motion.force_amplitude);
  visit(motion.largest_speed);
  visit(motion.inertia);
  visit(motion.torque);
}
} // namespace

MeshWall::MeshWall(std::string its_label, std::int64_t its_number,
                   const WallMaterial &law, FacetSurface at_start,
                   WallMotion its_motion)
    : FacetBoundary(std::move(its_label), its_number, law, std::move(at_start)),
      course(std::move(its_motion)), placed(surface.position)
{
  current.shift = prescribed_shift(course, 0.);
  const WallTransform moved(course, current);
  for (std::size_t v = 0; v < placed.size(); ++v)
    surface.position[v] = moved(placed[v]);
}

WallLoad load_on(const FacetSurface &surface, const Vec3 &about)
{
  WallLoad sum;
  for (std::size_t v = 0; v < surface.load.size(); ++v)
  {
    sum.force += surface.load[v];
    sum.moment += (surface.position[v] - about).cross(surface.load[v]);
  }
  return sum;
}

WallLoad MeshWall::load() const
{
  return load_on(surface, centre());
}

double MeshWall::body_volume() const
{
  for (const auto &neighbours : topology.neighbour)
    for (const std::int32_t other : neighbours)
      if (other < 0)
        return 0.;
  double sum = 0.; // positive where the particles are inside
  for (std::size_t t = 0; t < surface.triangles.size(); ++t)
  {
    const auto corner = corners_of(surface, static_cast<std::int32_t>(t));
    sum += corner[0].dot(corner[1].cross(corner[2])) / 6.;
  }
  return std::max(0., -sum);
}

void MeshWall::move(double time_step)
{
  const WallPose next = advanced(
      course, current, course.is_driven() ? load() : WallLoad{}, time_step);
  const bool is_still =
      next.shift == current.shift && next.angle == current.angle;
  current = next;
  const WallTransform moved(course, current);
  for (std::size_t v = 0; v < placed.size(); ++v)
  {
    const Vec3 now = is_still ? surface.position[v] : moved(placed[v]);
    surface.velocity[v] = (now - surface.position[v]) / time_step;
    surface.position[v] = now;
  }
}

void MeshWall::pack_parts(std::ostream &out) const
{
  FacetBoundary::pack_parts(out);
  visit_numbers(course, [&out](const auto &field) { write_value(out, field); });
  write_column(out, course.table_time);
  write_column(out, course.table_shift);
  write_value(out, current);
  write_column(out, placed);
}

void MeshWall::unpack_parts(std::istream &in)
{
  FacetBoundary::unpack_parts(in);
  visit_numbers(course, [&in](auto &field) { read_value(in, field); });
  read_column(in, course.table_time);
  read_column(in, course.table_shift);
  read_value(in, current);
  read_column(in, placed);
}
} // namespace dem
