#include <dem/boundary/facet_surface.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <tuple>

namespace dem
{
namespace
{
/// A cosine below this is a right angle; far above `snap`, so that a point
/// taken for a vertex is not beaten by its own neighbourhood [-].
constexpr double right_angle = 1e-11;

/// A point of an edge is its end if it is nearer to it than this times the
/// distance to the centre [-].
constexpr double snap = 1e-13;

/// Round-off of a computed point, as a part of its coordinates [-].
constexpr double round_off = 4e-15;

/// Minima whose directions are nearer than 45 degrees are one [-].
const double cos_patch = std::sqrt(0.5);

/// Whether a triangle that holds `point` has a point nearer to x: it is
/// convex, so it has one if and only if a corner v lies on the near side of
/// the plane through `point` normal to x - point, (v - point).(x - point) > 0.
bool comes_nearer(const FacetSurface &surface, std::int32_t triangle,
                  const Vec3 &point, const Vec3 &x)
{
  const Vec3 to_centre = x - point;
  for (const Vec3 &corner : corners_of(surface, triangle))
  {
    const Vec3 arm = corner - point;
    const double rise = arm.dot(to_centre);
    if (rise <= 0.) // most of them: no root needed
      continue;
    const double distance = to_centre.norm(), length = arm.norm();
    const double limit =
        right_angle * distance * length +
        round_off * (point.norm() + length) * (distance + length);
    if (rise > limit)
      return true;
  }
  return false;
}

/// Whether no triangle round the vertex comes nearer.
bool is_minimum_at_vertex(const FacetSurface &surface,
                          const FacetTopology &topology, std::int32_t vertex,
                          const Vec3 &x)
{
  const auto v = static_cast<std::size_t>(vertex);
  const auto first = topology.row_triangle.begin();
  return std::none_of(
      first + topology.row_start[v], first + topology.row_start[v + 1],
      [&](std::int32_t triangle)
      { return comes_nearer(surface, triangle, surface.position[v], x); });
}

/// Whether the nearest point of a triangle is a local minimum of the distance
/// to the whole surface.
bool is_minimum(const FacetSurface &surface, const FacetTopology &topology,
                const NearestPoint &nearest, const Vec3 &x, double distance)
{
  if (nearest.feature == Feature::face)
    return true;
  const auto triangle = static_cast<std::size_t>(nearest.triangle);
  const double near_end = snap * distance + round_off * nearest.point.norm();
  for (const std::int32_t vertex : surface.triangles[triangle])
  {
    const Vec3 &corner = surface.position[static_cast<std::size_t>(vertex)];
    if ((nearest.point - corner).squaredNorm() <= near_end * near_end)
      return is_minimum_at_vertex(surface, topology, vertex, x);
  }
  const std::int32_t other =
      topology.neighbour[triangle][static_cast<std::size_t>(nearest.which)];
  return other < 0 || !comes_nearer(surface, other, nearest.point, x);
}

/// Unit vector from x to the nearest point; the outward normal of the facet
/// if x lies on it (any unit vector if the facet has no area).
Vec3 direction_of(const FacetSurface &surface, const NearestPoint &nearest,
                  const Vec3 &x, double distance)
{
  if (distance > 0.)
    return (nearest.point - x) / distance;
  const auto corner = corners_of(surface, nearest.triangle);
  const Vec3 normal = (corner[1] - corner[0]).cross(corner[2] - corner[0]);
  const double length = normal.norm();
  return length > 0. ? Vec3(normal / length) : Vec3(Vec3::UnitZ());
}

/// Keeps the nearest of all whose directions are within 45 degrees; sorts.
void merge_patches(std::vector<NearestFacetPoint> &touches)
{
  std::sort(touches.begin(), touches.end(),
            [](const NearestFacetPoint &a, const NearestFacetPoint &b)
            {
              return std::tie(a.distance, a.nearest.triangle) <
                     std::tie(b.distance, b.nearest.triangle);
            });
  auto kept = touches.begin();
  for (auto touch = touches.begin(); touch != touches.end(); ++touch)
  {
    const bool is_new =
        std::none_of(touches.begin(), kept,
                     [&touch](const NearestFacetPoint &other) {
                       return other.direction.dot(touch->direction) > cos_patch;
                     });
    if (!is_new)
      continue;
    if (kept != touch)
      *kept = *touch;
    ++kept;
  }
  touches.erase(kept, touches.end());
}
} // namespace

NearestFacetPoint nearest_on_facet(const FacetSurface &surface,
                                   std::int32_t triangle, const Vec3 &x)
{
  NearestFacetPoint touch{nearest_point(x, corners_of(surface, triangle))};
  touch.nearest.triangle = triangle;
  touch.distance = (touch.nearest.point - x).norm();
  return touch;
}

void keep_minima(const FacetSurface &surface, const FacetTopology &topology,
                 const Vec3 &x, std::vector<NearestFacetPoint> &touches)
{
  std::erase_if(touches,
                [&](const NearestFacetPoint &touch) {
                  return !is_minimum(surface, topology, touch.nearest, x,
                                     touch.distance);
                });
  for (NearestFacetPoint &touch : touches)
    touch.direction = direction_of(surface, touch.nearest, x, touch.distance);
  if (touches.size() > 1)
    merge_patches(touches);
}
} // namespace dem
