#include <dem/shape/polygon.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace dem
{
namespace
{
using Vec2 = Eigen::Vector2d;

double cross(const Vec2 &a, const Vec2 &b)
{
  return a.x() * b.y() - a.y() * b.x();
}

/// From a point to the straight line between two others, its ends included.
double distance_to(const Vec2 &from, const Vec2 &to, const Vec2 &point)
{
  const Vec2 along = to - from;
  const double square = along.squaredNorm();
  const double share =
      square > 0. ? std::clamp((point - from).dot(along) / square, 0., 1.) : 0.;
  return (point - from - share * along).norm();
}

/// Marks the corners between first and last that are kept; last may be the
/// number of corners, which is corner 0 again.
void mark_kept(const Polygon &polygon, std::size_t first, std::size_t last,
               double tolerance, std::vector<bool> &is_kept)
{
  std::vector<std::pair<std::size_t, std::size_t>> open = {{first, last}};
  while (!open.empty())
  {
    const auto [from, to] = open.back();
    open.pop_back();
    double farthest = tolerance;
    std::size_t corner = 0;
    for (std::size_t k = from + 1; k < to; ++k)
    {
      const double distance =
          distance_to(polygon[from], polygon[to % polygon.size()], polygon[k]);
      if (distance > farthest)
      {
        farthest = distance;
        corner = k;
      }
    }
    if (corner == 0)
      continue;
    is_kept[corner] = true;
    open.push_back({from, corner});
    open.push_back({corner, to});
  }
}
} // namespace

double polygon_area(const Polygon &polygon)
{
  double twice = 0.;
  for (std::size_t k = 0; k < polygon.size(); ++k)
    twice += cross(polygon[k] - polygon[0],
                   polygon[(k + 1) % polygon.size()] - polygon[0]);
  return 0.5 * twice;
}

double polygon_area(std::span<const Polygon> polygons)
{
  double area = 0.;
  for (const Polygon &polygon : polygons)
    area += polygon_area(polygon);
  return area;
}

Vec2 polygon_centroid(const Polygon &polygon)
{
  const double area = polygon_area(polygon);
  Vec2 sum = Vec2::Zero(), mean = Vec2::Zero();
  for (std::size_t k = 0; k < polygon.size(); ++k)
  {
    const Vec2 a = polygon[k] - polygon[0],
               b = polygon[(k + 1) % polygon.size()] - polygon[0];
    sum += cross(a, b) / 6. * (a + b);
    mean += polygon[k] / static_cast<double>(polygon.size());
  }
  return area == 0. ? mean : Vec2(polygon[0] + sum / area);
}

Polygon circle_polygon(const Vec2 &centre, double radius)
{
  constexpr int n = 72;
  Polygon polygon;
  for (int k = 0; k < n; ++k)
  {
    const double angle = 2. * std::numbers::pi * k / n;
    polygon.push_back(centre + radius * Vec2(std::cos(angle), std::sin(angle)));
  }
  return polygon;
}

Polygon simplified(const Polygon &polygon, double tolerance)
{
  if (polygon.size() < 4)
    return polygon;
  std::size_t opposite = 0; // farthest from corner 0
  for (std::size_t k = 1; k < polygon.size(); ++k)
    if ((polygon[k] - polygon[0]).squaredNorm() >
        (polygon[opposite] - polygon[0]).squaredNorm())
      opposite = k;
  std::vector<bool> is_kept(polygon.size(), false);
  is_kept[0] = is_kept[opposite] = true;
  mark_kept(polygon, 0, opposite, tolerance, is_kept);
  mark_kept(polygon, opposite, polygon.size(), tolerance, is_kept);
  Polygon kept;
  for (std::size_t k = 0; k < polygon.size(); ++k)
    if (is_kept[k])
      kept.push_back(polygon[k]);
  return kept;
}
} // namespace dem
