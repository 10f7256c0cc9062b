#include "sure_climb.h"

#include <dem/contact/wall_place.h>

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

// With d = x - y, delta = d.n and t the rest of d, the point of the surface
// next to y is a step a away with a - delta K a = -t.
WallPlace depth_of(StoneView &stone, const Vec3 &point, const Vec3 &on_stone)
{
  WallPlace place;
  place.point = point;
  place.on_stone = on_stone;
  for (int step = 0; step < usual_pace.most_steps; ++step)
  {
    const SurfacePoint &at = stone.at(place.on_stone);
    const Vec3 apart = at.position - point;
    place.normal = at.normal;
    place.overlap = apart.dot(at.normal);
    const Frame frame = tangents(at.normal);
    const Vec2 aside = frame.transpose() * apart;
    if (aside.norm() < converged * stone.size())
    {
      place.is_found = true;
      break;
    }
    const Mat2 bend = frame.transpose() * at.bend * frame;
    // Beyond the centre of curvature the nearest point is another one.
    const Mat2 system =
        floored(Mat2::Identity() - place.overlap * bend, lowest_curvature);
    const Vec3 along = frame * Vec2(-(system.inverse() * aside));
    place.on_stone = stone.towards(
        at.position + shortened(along, usual_pace.longest_step * stone.size()));
  }
  return place;
}

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
    wall.bend = -(round * round.transpose()) / drum.radius;
  }
  return wall;
}

namespace
{
/// What counts as less deep than the start, of the radius: more than two
/// expansions of a surface differ by.
constexpr double surely_less = 1e-4;

WallPlace climb_at(const Pace &pace, StoneView &stone, const Drum &drum,
                   DrumPart part, const WallPlace &start)
{
  WallPlace place = start;
  place.is_found = false;
  double first_overlap = 0.;
  for (int step = 0; step < pace.most_steps && !place.is_found; ++step)
  {
    const SurfacePoint &at = stone.at(place.on_stone);
    if (part == DrumPart::cylinder &&
        out_of_axis(drum, at.position).norm() < 0.1 * drum.radius)
      break; // no side of the cylinder is nearer than another
    const SurfacePoint wall = smooth_drum(drum, part, at.position);
    const NormalStep newton =
        step_to_common_normal(at, wall, stone.size(), pace);
    place.normal = -wall.normal;
    place.point = wall.position;
    place.overlap = (at.position - wall.position).dot(place.normal);
    if (step == 0)
      first_overlap = place.overlap;
    place.is_found = newton.is_lens &&
                     newton.on_a.norm() < converged * stone.size() &&
                     at.normal.dot(place.normal) > 0.;
    if (!place.is_found)
      place.on_stone =
          stone.towards(at.position + shortened(newton.on_a, pace.longest_step *
                                                                 stone.size()));
  }
  // It has gone down, over to another place.
  if (place.overlap < first_overlap - surely_less * stone.size())
    place.is_found = false;
  return place;
}

/// The same without a step down, on the series.
WallPlace climb_drum_surely(const StoneView &stone, const Drum &drum,
                            DrumPart part, const WallPlace &start)
{
  const Mat3 back = stone.orientation().transpose();
  const auto depth = [&](const Vec3 &x)
  {
    const DrumPoint at = nearest_on_drum(drum, part, stone.in_world(x));
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
  const Summit top = climb_surely(stone.shape(), start.on_stone, depth);
  WallPlace place = start;
  place.on_stone = top.direction;
  const double radius = scaled_expansion(stone.shape(), top.direction).radius;
  const DrumPoint at =
      nearest_on_drum(drum, part, stone.in_world(radius * top.direction));
  place.normal = at.normal;
  place.point = at.point;
  place.overlap = -at.distance;
  place.is_found = top.is_found && (part != DrumPart::cylinder ||
                                    at.distance < 0.9 * drum.radius);
  return place;
}
} // namespace

WallPlace climb_drum(StoneView &stone, const Drum &drum, DrumPart part,
                     const WallPlace &start)
{
  for (const Pace &pace : {usual_pace, flat_pace})
    if (const WallPlace place = climb_at(pace, stone, drum, part, start);
        place.is_found)
      return place;
  return climb_drum_surely(stone, drum, part, start);
}

bool is_one_patch(const Vec3 &normal, const Vec3 &other)
{
  return normal.dot(other) > std::sqrt(0.5);
}
} // namespace dem
