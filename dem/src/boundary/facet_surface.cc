#include <dem/assert.h>
#include <dem/boundary/facet_surface.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <sstream>
#include <stdexcept>
#include <tuple>

namespace dem
{
namespace
{
/// A cosine within this of zero, and a weight within this of zero, count as
/// zero: round-off of coordinates is 1e-16 of the size of the surface [-].
constexpr double tolerance = 1e-9;

/// Minima whose directions are nearer than 45 degrees are one [-].
const double cos_patch = std::sqrt(0.5);

/// A face whose (height / size)^2 is below this is taken as its three sides:
/// the region test loses (distance / height)^2 1e-16 of the weights [-].
constexpr double sliver = 1e-12;

NearestPoint at_corner(const std::array<Vec3, 3> &corner, std::int32_t which)
{
  NearestPoint result;
  result.feature = Feature::vertex;
  result.which = which;
  result.weight[static_cast<std::size_t>(which)] = 1.;
  result.point = corner[static_cast<std::size_t>(which)];
  return result;
}

/// Point of side `which` at the fraction t from its first corner.
NearestPoint at_side(const std::array<Vec3, 3> &corner, std::int32_t which,
                     double t)
{
  const std::size_t from = static_cast<std::size_t>(which);
  const std::size_t to = (from + 1) % 3;
  NearestPoint result;
  result.feature = Feature::edge;
  result.which = which;
  result.weight[from] = 1. - t;
  result.weight[to] = t;
  result.point = corner[from] + t * (corner[to] - corner[from]);
  return result;
}

NearestPoint nearest_on_side(const Vec3 &x, const std::array<Vec3, 3> &corner,
                             std::int32_t which)
{
  const std::size_t from = static_cast<std::size_t>(which);
  const std::int32_t to = (which + 1) % 3;
  const Vec3 side = corner[static_cast<std::size_t>(to)] - corner[from];
  const double along = (x - corner[from]).dot(side);
  const double square = side.squaredNorm();
  if (along <= 0.)
    return at_corner(corner, which);
  if (along >= square)
    return at_corner(corner, to);
  return at_side(corner, which, along / square);
}

/// A triangle without area is its three sides.
NearestPoint on_sliver(const Vec3 &x, const std::array<Vec3, 3> &corner)
{
  NearestPoint best = nearest_on_side(x, corner, 0);
  for (const std::int32_t which : {1, 2})
  {
    const NearestPoint other = nearest_on_side(x, corner, which);
    if ((other.point - x).squaredNorm() < (best.point - x).squaredNorm())
      best = other;
  }
  return best;
}

std::array<Vec3, 3> corners(const FacetSurface &surface, std::int32_t triangle)
{
  const auto &vertex = surface.triangles[static_cast<std::size_t>(triangle)];
  return {surface.position[static_cast<std::size_t>(vertex[0])],
          surface.position[static_cast<std::size_t>(vertex[1])],
          surface.position[static_cast<std::size_t>(vertex[2])]};
}

/// A directed side of a triangle, with its ends in ascending order as key.
struct Side
{
  std::int32_t low = 0, high = 0; ///< vertices
  std::int32_t triangle = 0, which = 0;
  bool is_ascending = true; ///< runs from low to high

  bool joins(const Side &other) const
  {
    return low == other.low && high == other.high;
  }
};

std::vector<Side> sorted_sides(const FacetSurface &surface)
{
  std::vector<Side> sides;
  sides.reserve(3 * surface.triangles.size());
  for (std::size_t k = 0; k < surface.triangles.size(); ++k)
    for (std::size_t which = 0; which < 3; ++which)
    {
      const std::int32_t from = surface.triangles[k][which];
      const std::int32_t to = surface.triangles[k][(which + 1) % 3];
      sides.push_back({std::min(from, to), std::max(from, to),
                       static_cast<std::int32_t>(k),
                       static_cast<std::int32_t>(which), from < to});
    }
  std::sort(sides.begin(), sides.end(),
            [](const Side &a, const Side &b)
            {
              return std::tie(a.low, a.high, a.triangle) <
                     std::tie(b.low, b.high, b.triangle);
            });
  return sides;
}

void check_vertices(const FacetSurface &surface)
{
  const auto n_vertices = static_cast<std::int32_t>(surface.position.size());
  for (std::size_t k = 0; k < surface.triangles.size(); ++k)
  {
    const auto &vertex = surface.triangles[k];
    std::ostringstream message;
    for (const std::int32_t v : vertex)
      if (v < 0 || v >= n_vertices)
        message << "facet " << k << " names vertex " << v << "; 0 to "
                << n_vertices - 1 << " are allowed";
    if (vertex[0] == vertex[1] || vertex[1] == vertex[2] ||
        vertex[2] == vertex[0])
      message << "facet " << k << " names vertex "
              << (vertex[0] == vertex[1] ? vertex[0] : vertex[2])
              << " twice; three different vertices are needed";
    if (!message.str().empty())
      throw std::invalid_argument(message.str());
  }
}

/// Two facets share a side, run through in opposite directions; never three.
void check_sides(const Side &a, const Side &b, bool has_third)
{
  if (!has_third && a.is_ascending != b.is_ascending)
    return;
  std::ostringstream message;
  message << "facets " << a.triangle << " and " << b.triangle
          << " at the edge of vertices " << a.low << " and " << a.high;
  message << (has_third ? " share it with a third one; at most two are allowed"
                        : " have opposite orientation; one must be turned");
  throw std::invalid_argument(message.str());
}

/// Rows of the triangles round each vertex, in ascending order.
void fill_rows(const FacetSurface &surface, FacetTopology &topology)
{
  topology.row_start.assign(surface.position.size() + 1, 0);
  for (const auto &vertex : surface.triangles)
    for (const std::int32_t v : vertex)
      ++topology.row_start[static_cast<std::size_t>(v) + 1];
  for (std::size_t v = 0; v < surface.position.size(); ++v)
    topology.row_start[v + 1] += topology.row_start[v];
  topology.row_triangle.resize(3 * surface.triangles.size());
  std::vector<std::int32_t> next = topology.row_start;
  for (std::size_t k = 0; k < surface.triangles.size(); ++k)
    for (const std::int32_t v : surface.triangles[k])
      topology.row_triangle[static_cast<std::size_t>(
          next[static_cast<std::size_t>(v)]++)] = static_cast<std::int32_t>(k);
}

/// Whether a triangle that holds `point` has a point nearer to x: it is
/// convex, so it has one if and only if a corner v lies on the near side of
/// the plane through `point` normal to x - point, (v - point).(x - point) > 0.
bool comes_nearer(const FacetSurface &surface, std::int32_t triangle,
                  const Vec3 &point, const Vec3 &to_centre)
{
  // The second term is the round-off of the coordinates.
  const double limit = tolerance * to_centre.norm() + 1e-15 * point.norm();
  for (const Vec3 &corner : corners(surface, triangle))
  {
    const Vec3 arm = corner - point;
    if (arm.dot(to_centre) > limit * arm.norm())
      return true;
  }
  return false;
}

/// Whether no triangle round the vertex comes nearer.
bool is_minimum_at_vertex(const FacetSurface &surface,
                          const FacetTopology &topology, std::int32_t vertex,
                          const NearestPoint &nearest, const Vec3 &to_centre)
{
  const auto v = static_cast<std::size_t>(vertex);
  for (std::int32_t k = topology.row_start[v]; k < topology.row_start[v + 1];
       ++k)
  {
    const std::int32_t other =
        topology.row_triangle[static_cast<std::size_t>(k)];
    if (other != nearest.triangle &&
        comes_nearer(surface, other, nearest.point, to_centre))
      return false;
  }
  return true;
}

/// Whether the nearest point of a triangle is a local minimum of the distance
/// to the whole surface.
bool is_minimum(const FacetSurface &surface, const FacetTopology &topology,
                const NearestPoint &nearest, const Vec3 &x)
{
  if (nearest.feature == Feature::face)
    return true;
  const auto triangle = static_cast<std::size_t>(nearest.triangle);
  const Vec3 to_centre = x - nearest.point;
  // A point of an edge within round-off of its end is judged as that end.
  for (std::size_t corner = 0; corner < 3; ++corner)
    if (nearest.weight[corner] > 1. - tolerance)
      return is_minimum_at_vertex(surface, topology,
                                  surface.triangles[triangle][corner], nearest,
                                  to_centre);
  const std::int32_t other =
      topology.neighbour[triangle][static_cast<std::size_t>(nearest.which)];
  return other < 0 || !comes_nearer(surface, other, nearest.point, to_centre);
}

/// Unit vector from x to the nearest point; the outward normal of the facet
/// if x lies on it (any unit vector if the facet has no area).
Vec3 direction_of(const FacetSurface &surface, const NearestPoint &nearest,
                  const Vec3 &x, double distance)
{
  if (distance > 0.)
    return (nearest.point - x) / distance;
  const auto corner = corners(surface, nearest.triangle);
  const Vec3 normal = (corner[1] - corner[0]).cross(corner[2] - corner[0]);
  const double length = normal.norm();
  return length > 0. ? Vec3(normal / length) : Vec3(Vec3::UnitZ());
}

/// Keeps the nearest of all whose directions are within 45 degrees; sorts.
void merge_patches(std::vector<FacetTouch> &touches, std::size_t begin)
{
  const auto first = touches.begin() + static_cast<std::ptrdiff_t>(begin);
  std::sort(first, touches.end(),
            [](const FacetTouch &a, const FacetTouch &b)
            {
              return std::tie(a.distance, a.nearest.triangle) <
                     std::tie(b.distance, b.nearest.triangle);
            });
  auto kept = first;
  for (auto touch = first; touch != touches.end(); ++touch)
  {
    const bool is_new =
        std::none_of(first, kept,
                     [&touch](const FacetTouch &other) {
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

// Region test of Ericson (2005), Real-Time Collision Detection, 5.1.5.
NearestPoint nearest_point(const Vec3 &x, const std::array<Vec3, 3> &corner)
{
  const Vec3 ab = corner[1] - corner[0], ac = corner[2] - corner[0];
  const Vec3 ap = x - corner[0], bp = x - corner[1], cp = x - corner[2];
  const double d1 = ab.dot(ap), d2 = ac.dot(ap);
  if (d1 <= 0. && d2 <= 0.)
    return at_corner(corner, 0);
  const double d3 = ab.dot(bp), d4 = ac.dot(bp);
  if (d3 >= 0. && d4 <= d3)
    return at_corner(corner, 1);
  const double d5 = ab.dot(cp), d6 = ac.dot(cp);
  if (d6 >= 0. && d5 <= d6)
    return at_corner(corner, 2);

  // A side of no length is passed over: one of the other two will do.
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0. && d1 >= 0. && d3 <= 0. && d1 > d3)
    return at_side(corner, 0, d1 / (d1 - d3));
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0. && d4 >= d3 && d5 >= d6 && (d4 - d3) + (d5 - d6) > 0.)
    return at_side(corner, 1, (d4 - d3) / ((d4 - d3) + (d5 - d6)));
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0. && d2 >= 0. && d6 <= 0. && d2 > d6)
    return at_side(corner, 2, d6 / (d6 - d2));

  const double side = std::max(ab.squaredNorm(), ac.squaredNorm());
  const double sum = va + vb + vc; // |ab x ac|^2
  if (!(sum > sliver * side * std::max(side, ap.squaredNorm())))
    return on_sliver(x, corner);
  NearestPoint result;
  result.weight = {1. - vb / sum - vc / sum, vb / sum, vc / sum};
  result.point = corner[0] + result.weight[1] * ab + result.weight[2] * ac;
  return result;
}

FacetTopology::FacetTopology(const FacetSurface &surface)
{
  check_vertices(surface);
  neighbour.assign(surface.triangles.size(), {-1, -1, -1});
  const std::vector<Side> sides = sorted_sides(surface);
  for (std::size_t k = 0; k + 1 < sides.size(); ++k)
  {
    const Side &a = sides[k], &b = sides[k + 1];
    if (!a.joins(b))
      continue;
    check_sides(a, b, k + 2 < sides.size() && a.joins(sides[k + 2]));
    neighbour[static_cast<std::size_t>(a.triangle)]
             [static_cast<std::size_t>(a.which)] = b.triangle;
    neighbour[static_cast<std::size_t>(b.triangle)]
             [static_cast<std::size_t>(b.which)] = a.triangle;
  }
  fill_rows(surface, *this);
}

void find_touches(const FacetSurface &surface, const FacetTopology &topology,
                  std::span<const std::int32_t> candidates, const Vec3 &x,
                  double reach, std::vector<FacetTouch> &touches)
{
  const std::size_t begin = touches.size();
  for (const std::int32_t triangle : candidates)
  {
    NearestPoint nearest = nearest_point(x, corners(surface, triangle));
    nearest.triangle = triangle;
    const double distance = (nearest.point - x).norm();
    if (!(distance < reach) || !is_minimum(surface, topology, nearest, x))
      continue;
    touches.push_back(
        {nearest, direction_of(surface, nearest, x, distance), distance});
  }
  if (touches.size() > begin + 1)
    merge_patches(touches, begin);
}
} // namespace dem
