#include "convex_hull.h"

#include <dem/assert.h>
#include <dem/shape/form.h>
#include <dem/shape/quadrature.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace dem
{
namespace
{
std::vector<Vec3> surface_points(std::span<const double> coefficients,
                                 const SphereQuadrature &rule)
{
  const std::vector<double> radii = node_radii(coefficients, rule);
  std::vector<Vec3> points;
  points.reserve(radii.size());
  for (std::size_t k = 0; k < radii.size(); ++k)
    points.push_back(radii[k] * rule.direction[k]);
  return points;
}

/// The two points that are farthest apart: those far out first, until two
/// radii together are no longer enough.
Vec3 longest_chord(std::vector<Vec3> points)
{
  std::sort(points.begin(), points.end(),
            [](const Vec3 &a, const Vec3 &b)
            { return a.squaredNorm() > b.squaredNorm(); });
  std::vector<double> radii;
  for (const Vec3 &point : points)
    radii.push_back(point.norm());
  Vec3 longest = Vec3::Zero();
  double length = 0.;
  for (std::size_t i = 0; i < points.size() && 2. * radii[i] > length; ++i)
    for (std::size_t j = i + 1;
         j < points.size() && radii[i] + radii[j] > length; ++j)
      if ((points[i] - points[j]).squaredNorm() > length * length)
      {
        longest = points[i] - points[j];
        length = longest.norm();
      }
  return longest;
}

/// Caliper of the points along the unit vector.
double width_along(std::span<const Vec3> points, const Vec3 &axis)
{
  double lowest = axis.dot(points[0]), highest = lowest;
  for (const Vec3 &point : points)
  {
    lowest = std::min(lowest, axis.dot(point));
    highest = std::max(highest, axis.dot(point));
  }
  return highest - lowest;
}

/// Volume of the polyhedron of the nodes: rings of triangles, closed by a fan
/// at either pole.
double polyhedron_volume(std::span<const Vec3> points,
                         const SphereQuadrature &rule)
{
  const auto at = [&](int ring, int k) -> const Vec3 &
  { return points[std::size_t(ring * rule.n_azimuth + k % rule.n_azimuth)]; };
  const auto six = [](const Vec3 &a, const Vec3 &b, const Vec3 &c)
  { return a.dot(b.cross(c)); };
  const int last = rule.n_polar - 1;
  double sum = 0.;
  for (int k = 0; k < rule.n_azimuth; ++k)
  {
    // rings go from the south pole to the north pole
    for (int ring = 0; ring < last; ++ring)
      sum += six(at(ring, k), at(ring, k + 1), at(ring + 1, k + 1)) +
             six(at(ring, k), at(ring + 1, k + 1), at(ring + 1, k));
    sum += six(at(0, 0), at(0, k + 1), at(0, k)) +
           six(at(last, 0), at(last, k), at(last, k + 1));
  }
  return sum / 6.;
}
} // namespace

Calipers calipers(std::span<const double> coefficients)
{
  static const SphereQuadrature rule = make_quadrature(80, 160);
  const std::vector<Vec3> points = surface_points(coefficients, rule);
  const Vec3 chord = longest_chord(points);
  const Vec3 axis = chord.normalized();
  const Vec3 first = axis.unitOrthogonal(), second = axis.cross(first);
  Calipers of{chord.norm(), 0., 0.};
  double widest = 0.;
  constexpr int n_angles = 180;
  const auto across = [&](double angle) -> Vec3
  { return std::cos(angle) * first + std::sin(angle) * second; };
  for (int k = 0; k < n_angles; ++k)
  {
    const double angle = std::numbers::pi * k / n_angles;
    const double width = width_along(points, across(angle));
    if (width > of.width)
    {
      of.width = width;
      widest = angle;
    }
  }
  of.thickness = width_along(points, across(widest + 0.5 * std::numbers::pi));
  return of;
}

double convexity(std::span<const double> coefficients)
{
  static const SphereQuadrature rule = make_quadrature(60, 120);
  const std::vector<Vec3> points = surface_points(coefficients, rule);
  return polyhedron_volume(points, rule) / detail::convex_hull_volume(points);
}
} // namespace dem
