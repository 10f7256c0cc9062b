#include "mesh_edges.h"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <tuple>
#include <utility>

namespace dem::detail
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

/// Where the sides of one edge end, in a list that is sorted.
Index end_of_edge(const std::vector<Side> &sides, Index first)
{
  Index end = first + 1;
  while (end < sides.size() && sides[end].low == sides[first].low &&
         sides[end].high == sides[first].high)
    ++end;
  return end;
}

/// All triangles that hang together with `first`; `sign` is 0 where no body has
/// been yet, then 1, or -1 where the triangle has to be turned.
MeshBody find_body(const MeshEdges &edges, Index first, std::vector<int> &sign)
{
  MeshBody body{{first}};
  sign[first] = 1;
  for (Index next = 0; next < body.triangles.size(); ++next)
  {
    const Index t = body.triangles[next];
    for (const MeshLink &link : edges.links[t])
    {
      const int wanted = link.is_against ? -sign[t] : sign[t];
      int &other = sign[Index(link.other)];
      if (other == 0)
        body.triangles.push_back(Index(link.other));
      else if (other != wanted)
        throw std::invalid_argument("mesh has no inside: its triangles cannot "
                                    "be turned one way");
      other = wanted;
    }
  }
  return body;
}
} // namespace

MeshEdges find_edges(const std::vector<Triangle> &triangles)
{
  const std::vector<Side> sides = sorted_sides(triangles);
  MeshEdges edges;
  edges.links.resize(triangles.size());
  for (Index i = 0, end = 0; i < sides.size(); i = end)
  {
    end = end_of_edge(sides, i);
    edges.n_open += end - i == 1;
    edges.n_shared += end - i > 2;
    if (end - i != 2)
      continue;
    const Side &a = sides[i], &b = sides[i + 1];
    const bool is_against = a.is_rising == b.is_rising;
    edges.links[Index(a.triangle)].push_back({b.triangle, is_against});
    edges.links[Index(b.triangle)].push_back({a.triangle, is_against});
  }
  return edges;
}

std::vector<MeshBody> turn_one_way(TriangleMesh &mesh, const MeshEdges &edges)
{
  std::vector<int> sign(mesh.triangles.size(), 0);
  std::vector<MeshBody> bodies;
  for (Index t = 0; t < sign.size(); ++t)
    if (sign[t] == 0)
      bodies.push_back(find_body(edges, t, sign));
  for (MeshBody &body : bodies)
    for (const Index t : body.triangles)
      if (sign[t] < 0)
      {
        std::swap(mesh.triangles[t][1], mesh.triangles[t][2]);
        ++body.n_turned;
      }
  return bodies;
}

void turn_over(TriangleMesh &mesh, const MeshBody &body)
{
  for (const Index t : body.triangles)
    std::swap(mesh.triangles[t][1], mesh.triangles[t][2]);
}

double six_volume(const TriangleMesh &mesh, const Triangle &t)
{
  return mesh.points[Index(t[0])].dot(
      mesh.points[Index(t[1])].cross(mesh.points[Index(t[2])]));
}

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
} // namespace dem::detail
