#include <dem/boundary/wall_clearance.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace dem
{
namespace
{
bool is_closed(const FacetSurface &surface)
{
  const FacetTopology topology(surface);
  return std::ranges::all_of(topology.neighbour, [](const auto &sides)
                             { return std::ranges::min(sides) >= 0; });
}

double six_volume(const FacetSurface &surface)
{
  double volume = 0.;
  for (std::size_t t = 0; t < surface.triangles.size(); ++t)
  {
    const auto corner = corners_of(surface, static_cast<std::int32_t>(t));
    const Vec3 &origin = surface.position[0];
    volume += (corner[0] - origin)
                  .dot((corner[1] - origin).cross(corner[2] - origin));
  }
  return volume;
}

/// Solid angle of the surface about x over that of a sphere: 1 inside of a
/// closed surface whose facets show outward, 0 outside (Van Oosterom and
/// Strackee 1983) [-].
double winding_number(const FacetSurface &surface, const Vec3 &x)
{
  double angle = 0.;
  for (std::size_t t = 0; t < surface.triangles.size(); ++t)
  {
    const auto corner = corners_of(surface, static_cast<std::int32_t>(t));
    const Vec3 a = corner[0] - x, b = corner[1] - x, c = corner[2] - x;
    const double u = a.norm(), v = b.norm(), w = c.norm();
    angle +=
        2. * std::atan2(a.dot(b.cross(c)),
                        u * v * w + a.dot(b) * w + b.dot(c) * u + c.dot(a) * v);
  }
  return angle / (4. * std::numbers::pi);
}

bool is_far(const FacetSurface &surface, const Vec3 &centre, double radius)
{
  for (std::size_t t = 0; t < surface.triangles.size(); ++t)
    if ((nearest_point(centre,
                       corners_of(surface, static_cast<std::int32_t>(t)))
             .point -
         centre)
            .squaredNorm() < radius * radius)
      return false;
  return true;
}
} // namespace

void WallClearance::add(const FacetSurface &surface)
{
  Wall wall{surface, surface.position[0], surface.position[0]};
  for (const Vec3 &point : surface.position)
  {
    wall.lower = wall.lower.cwiseMin(point);
    wall.upper = wall.upper.cwiseMax(point);
  }
  wall.is_closed = is_closed(surface);
  wall.holds_particles = six_volume(surface) > 0.;
  walls.push_back(std::move(wall));
}

bool WallClearance::is_clear(const Vec3 &centre, double radius) const
{
  return std::ranges::all_of(
      walls,
      [&](const Wall &wall)
      {
        const Vec3 outside =
            (wall.lower - centre)
                .cwiseMax((centre - wall.upper).cwiseMax(Vec3::Zero()));
        if (const double away = outside.norm(); away > 0. && away >= radius)
          return !(wall.is_closed && wall.holds_particles);
        if (wall.is_closed && winding_number(wall.surface, centre) <
                                  (wall.holds_particles ? 0.5 : -0.5))
          return false;
        return is_far(wall.surface, centre, radius);
      });
}
} // namespace dem
