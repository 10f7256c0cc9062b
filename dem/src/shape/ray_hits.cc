#include "ray_hits.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace dem::detail
{
namespace
{
using Triangle = std::array<std::int32_t, 3>;

/// d . (a x b); of opposite sign, to the last bit, if a and b are exchanged.
double edge_side(const TriangleMesh &mesh, const Vec3 &d, std::int32_t a,
                 std::int32_t b)
{
  const Vec3 &low = mesh.points[std::size_t(std::min(a, b))];
  const Vec3 &high = mesh.points[std::size_t(std::max(a, b))];
  const double side = d.dot(low.cross(high));
  return a < b ? side : -side;
}

void add_hit(const TriangleMesh &mesh, const Triangle &t, const Vec3 &d,
             RayHits &hits)
{
  const double u = edge_side(mesh, d, t[1], t[2]);
  const double v = edge_side(mesh, d, t[2], t[0]);
  const double w = edge_side(mesh, d, t[0], t[1]);
  const bool is_front = u > 0. && v > 0. && w > 0.;
  const bool is_back = u < 0. && v < 0. && w < 0.;
  if (!is_front && !is_back) // an exact zero is settled by moving the ray
    return;
  const Vec3 point =
      (u * mesh.points[std::size_t(t[0])] + v * mesh.points[std::size_t(t[1])] +
       w * mesh.points[std::size_t(t[2])]) /
      (u + v + w);
  const double distance = d.dot(point);
  if (!(distance > 0.)) // on the other side of the origin
    return;
  const int sign = is_front ? 1 : -1;
  ++hits.n_hits;
  hits.winding += sign;
  hits.outermost = std::max(hits.outermost, distance);
  hits.signed_cube += sign * std::pow(distance, 3);
}

/// A cap of the sphere that contains the triangle, from the origin.
struct Cap
{
  Vec3 axis = Vec3::UnitZ();
  double half_angle = std::numbers::pi; ///< pi: the whole sphere [rad]
};

Cap cap_around(const TriangleMesh &mesh, const Triangle &t)
{
  Vec3 corner[3], sum = Vec3::Zero();
  for (int i = 0; i < 3; ++i)
  {
    corner[i] = mesh.points[std::size_t(t[std::size_t(i)])];
    const double length = corner[i].norm();
    if (!(length > 0.)) // the origin is a corner
      return {};
    corner[i] /= length;
    sum += corner[i];
  }
  const double length = sum.norm();
  if (length < 1.) // wider than a cap can hold
    return {};
  Cap cap;
  cap.axis = sum / length;
  double lowest = 1.;
  for (const Vec3 &c : corner)
    lowest = std::min(lowest, cap.axis.dot(c));
  // a cap holds the triangle only if it is smaller than a hemisphere
  cap.half_angle = lowest < 0.1 ? std::numbers::pi : std::acos(lowest) + 1e-7;
  return cap;
}

/// Half the range of azimuth of the cap [rad].
double azimuth_range(const Cap &cap)
{
  const double polar = std::acos(std::clamp(cap.axis.z(), -1., 1.));
  if (polar <= cap.half_angle || std::numbers::pi - polar <= cap.half_angle)
    return std::numbers::pi;
  return std::asin(std::min(1., std::sin(cap.half_angle) / std::sin(polar)));
}

void add_triangle(const TriangleMesh &mesh, const Triangle &t,
                  const SphereQuadrature &rule, std::vector<RayHits> &hits)
{
  const Cap cap = cap_around(mesh, t);
  const double polar = std::acos(std::clamp(cap.axis.z(), -1., 1.));
  const double low =
      std::cos(std::min(polar + cap.half_angle, std::numbers::pi));
  const double high = std::cos(std::max(polar - cap.half_angle, 0.));
  const double step = 2. * std::numbers::pi / rule.n_azimuth;
  const double middle = std::atan2(cap.axis.y(), cap.axis.x());
  const double range = azimuth_range(cap);
  const int first = int(std::floor((middle - range) / step));
  const int n = std::min(int(std::ceil(2. * range / step)) + 2, rule.n_azimuth);
  const auto &rings = rule.ring_cosine;
  for (auto ring = std::lower_bound(rings.begin(), rings.end(), low);
       ring != rings.end() && *ring <= high; ++ring)
    for (int i = 0; i < n; ++i)
    {
      const int azimuth =
          ((first + i) % rule.n_azimuth + rule.n_azimuth) % rule.n_azimuth;
      const auto k =
          std::size_t((ring - rings.begin()) * rule.n_azimuth + azimuth);
      add_hit(mesh, t, rule.direction[k], hits[k]);
    }
}

RayHits cast_one(const TriangleMesh &mesh, const Vec3 &direction)
{
  RayHits hits;
  for (const Triangle &t : mesh.triangles)
    add_hit(mesh, t, direction, hits);
  return hits;
}

/// The winding number of the origin: the majority of the rays.
int common_winding(const std::vector<RayHits> &hits)
{
  std::vector<int> winding;
  winding.reserve(hits.size());
  for (const RayHits &hit : hits)
    winding.push_back(hit.winding);
  const auto middle = winding.begin() + std::ptrdiff_t(winding.size() / 2);
  std::nth_element(winding.begin(), middle, winding.end());
  return *middle;
}
} // namespace

std::vector<RayHits> cast_rays(const TriangleMesh &mesh,
                               const SphereQuadrature &rule)
{
  std::vector<RayHits> hits(rule.direction.size());
  for (const Triangle &t : mesh.triangles)
    add_triangle(mesh, t, rule, hits);
  const int winding = common_winding(hits);
  for (std::size_t k = 0; k < hits.size(); ++k)
    for (int attempt = 1; attempt <= 5 && hits[k].winding != winding; ++attempt)
    {
      const Vec3 aside(std::cos(attempt), std::sin(attempt), 0.5);
      hits[k] = cast_one(
          mesh, (rule.direction[k] + 1e-9 * attempt * aside).normalized());
    }
  return hits;
}
} // namespace dem::detail
