#include "closed_mesh.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <stdexcept>
#include <string>
#include <tuple>
#include <utility>

namespace dem
{
namespace
{
using Triangle = std::array<std::int32_t, 3>;
using Index = std::size_t;

/// One side of one triangle; two of them make an edge of a closed mesh.
struct Side
{
  std::int32_t low = 0, high = 0; ///< point numbers
  std::int32_t triangle = 0;
  bool is_rising = false; ///< runs from low to high
};

/// The two triangles at an edge, and whether they run along it the same way.
struct Link
{
  std::int32_t other = 0;
  bool is_against = false; ///< one of the two has to be turned
};

void require_sound(const TriangleMesh &mesh)
{
  if (mesh.triangles.empty())
    throw std::invalid_argument("mesh has no triangles");
  for (Index i = 0; i < mesh.points.size(); ++i)
    if (!mesh.points[i].allFinite())
      throw std::invalid_argument("mesh point " + std::to_string(i) +
                                  " is not finite");
  const auto n_points = std::int32_t(mesh.points.size());
  for (const Triangle &triangle : mesh.triangles)
    for (const std::int32_t point : triangle)
      if (point < 0 || point >= n_points)
        throw std::invalid_argument("mesh triangle names point " +
                                    std::to_string(point) + ", must be 0 .. " +
                                    std::to_string(n_points - 1));
}

std::vector<Side> sorted_sides(const std::vector<Triangle> &triangles)
{
  std::vector<Side> sides;
  sides.reserve(3 * triangles.size());
  for (Index t = 0; t < triangles.size(); ++t)
    for (Index i = 0; i < 3; ++i)
    {
      const std::int32_t a = triangles[t][i], b = triangles[t][(i + 1) % 3];
      sides.push_back({std::min(a, b), std::max(a, b), std::int32_t(t), a < b});
    }
  std::sort(sides.begin(), sides.end(),
            [](const Side &a, const Side &b)
            {
              return std::tie(a.low, a.high, a.triangle) <
                     std::tie(b.low, b.high, b.triangle);
            });
  return sides;
}

/// Of the diagonal of the box round a mesh: points that are nearer than this
/// are one point if the mesh is open without [-].
constexpr double weld_share = 1e-6;

std::string short_text(double value)
{
  char text[32];
  std::snprintf(text, sizeof text, "%.3g", value);
  return text;
}

void throw_open(Index n_open, Index n_shared)
{
  if (n_open > 0)
    throw std::invalid_argument(
        "mesh is open: " + std::to_string(n_open) +
        " edges belong to one triangle only, every edge must have two; points "
        "up to " +
        short_text(weld_share) + " of its diagonal apart are taken as one");
  if (n_shared > 0)
    throw std::invalid_argument(
        "mesh is no single surface: " + std::to_string(n_shared) +
        " edges belong to more than two triangles, every edge must have two");
}

/// Where the sides of one edge end, in a list that is sorted.
Index end_of_edge(const std::vector<Side> &sides, Index first)
{
  Index end = first + 1;
  while (end < sides.size() && sides[end].low == sides[first].low &&
         sides[end].high == sides[first].high)
    ++end;
  return end;
}

bool is_open(const TriangleMesh &mesh)
{
  const std::vector<Side> sides = sorted_sides(mesh.triangles);
  for (Index i = 0, end = 0; i < sides.size(); i = end)
  {
    end = end_of_edge(sides, i);
    if (end - i == 1)
      return true;
  }
  return false;
}

/// Three links per triangle, in no particular order.
std::vector<std::vector<Link>>
find_links(const std::vector<Triangle> &triangles)
{
  const std::vector<Side> sides = sorted_sides(triangles);
  std::vector<std::vector<Link>> links(triangles.size());
  Index n_open = 0, n_shared = 0;
  for (Index i = 0, end = 0; i < sides.size(); i = end)
  {
    end = end_of_edge(sides, i);
    n_open += end - i == 1;
    n_shared += end - i > 2;
    if (end - i != 2)
      continue;
    const Side &a = sides[i], &b = sides[i + 1];
    const bool is_against = a.is_rising == b.is_rising;
    links[Index(a.triangle)].push_back({b.triangle, is_against});
    links[Index(b.triangle)].push_back({a.triangle, is_against});
  }
  throw_open(n_open, n_shared);
  return links;
}

/// Six times the volume between the triangle and the origin.
double six_volume(const TriangleMesh &mesh, const Triangle &t)
{
  return mesh.points[Index(t[0])].dot(
      mesh.points[Index(t[1])].cross(mesh.points[Index(t[2])]));
}

/// Turns the triangles of the body of `first` one way, then outward.
void turn_body(TriangleMesh &mesh, const std::vector<std::vector<Link>> &links,
               Index first, std::vector<int> &sign)
{
  std::vector<Index> body = {first};
  sign[first] = 1;
  double volume = 0.;
  for (Index next = 0; next < body.size(); ++next)
  {
    const Index t = body[next];
    volume += sign[t] * six_volume(mesh, mesh.triangles[t]);
    for (const Link &link : links[t])
    {
      const int wanted = link.is_against ? -sign[t] : sign[t];
      int &other = sign[Index(link.other)];
      if (other == 0)
        body.push_back(Index(link.other));
      else if (other != wanted)
        throw std::invalid_argument("mesh has no inside: its triangles cannot "
                                    "be turned one way");
      other = wanted;
    }
  }
  for (const Index t : body)
    if ((sign[t] < 0) != (volume < 0.))
      std::swap(mesh.triangles[t][1], mesh.triangles[t][2]);
}

int turn_outward(TriangleMesh &mesh)
{
  const std::vector<std::vector<Link>> links = find_links(mesh.triangles);
  std::vector<int> sign(mesh.triangles.size(), 0);
  int n_bodies = 0;
  for (Index t = 0; t < sign.size(); ++t)
    if (sign[t] == 0)
    {
      turn_body(mesh, links, t, sign);
      ++n_bodies;
    }
  return n_bodies;
}

double diagonal(const TriangleMesh &mesh)
{
  Vec3 lower = mesh.points[0], upper = lower;
  for (const Vec3 &point : mesh.points)
  {
    lower = lower.cwiseMin(point);
    upper = upper.cwiseMax(point);
  }
  return (upper - lower).norm();
}

/// Takes near points as one. Files with few digits need it.
void weld_near(detail::ClosedMesh &closed)
{
  const double tolerance = weld_share * diagonal(closed.mesh);
  TriangleMesh welded = weld(closed.mesh, tolerance);
  if (welded.points.size() == closed.mesh.points.size())
    return;
  closed.weld_distance = tolerance;
  closed.n_welded =
      std::int32_t(closed.mesh.points.size() - welded.points.size());
  closed.mesh = std::move(welded);
}

/// The first point of the mesh is the origin of the sums, so that a mesh far
/// from zero loses no digits.
void add_integrals(detail::ClosedMesh &closed)
{
  TriangleMesh near = closed.mesh;
  for (Vec3 &point : near.points)
    point -= closed.mesh.points[0];
  Vec3 moment = Vec3::Zero();
  for (const Triangle &t : near.triangles)
  {
    const Vec3 &a = near.points[Index(t[0])], &b = near.points[Index(t[1])],
               &c = near.points[Index(t[2])];
    const double volume = six_volume(near, t) / 6.;
    closed.volume += volume;
    closed.area += 0.5 * (b - a).cross(c - a).norm();
    moment += 0.25 * volume * (a + b + c);
  }
  // a box has V^2 / S^3 = 1 / 216 at most; 1e-9 is flat
  if (!(closed.volume > 1e-9 * std::pow(closed.area, 1.5)))
    throw std::invalid_argument("mesh encloses no volume");
  closed.centroid = closed.mesh.points[0] + moment / closed.volume;
}
} // namespace

namespace detail
{
ClosedMesh close_mesh(const TriangleMesh &mesh)
{
  require_sound(mesh);
  ClosedMesh closed;
  closed.mesh = weld(mesh);
  if (is_open(closed.mesh))
    weld_near(closed);
  require_sound(closed.mesh);
  closed.n_bodies = turn_outward(closed.mesh);
  add_integrals(closed);
  return closed;
}
} // namespace detail
} // namespace dem
