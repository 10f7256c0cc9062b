#include <dem/boundary/facet_surface.h>

#include <algorithm>
#include <cstddef>
#include <sstream>
#include <stdexcept>
#include <tuple>

namespace dem
{
namespace
{
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

/// Three vertices that exist and differ.
void check_vertices(const FacetSurface &surface, std::size_t facet)
{
  const auto n_vertices = static_cast<std::int32_t>(surface.position.size());
  const auto &vertex = surface.triangles[facet];
  std::ostringstream message;
  for (const std::int32_t v : vertex)
    if (message.str().empty() && (v < 0 || v >= n_vertices))
      message << "facet " << facet << " names vertex " << v << "; 0 to "
              << n_vertices - 1 << " are allowed";
  if (message.str().empty() &&
      (vertex[0] == vertex[1] || vertex[1] == vertex[2] ||
       vertex[2] == vertex[0]))
    message << "facet " << facet << " names vertex "
            << (vertex[0] == vertex[1] ? vertex[0] : vertex[2])
            << " twice; three different vertices are needed";
  if (!message.str().empty())
    throw std::invalid_argument(message.str());
}

/// At a finite position and with an area: a facet thinner than this part of its
/// longest side does not define the nearer neighbour.
void check_area(const FacetSurface &surface, std::size_t facet)
{
  constexpr double least_height = 1e-9;
  std::array<Vec3, 3> corner;
  for (std::size_t k = 0; k < 3; ++k)
    corner[k] =
        surface.position[static_cast<std::size_t>(surface.triangles[facet][k])];
  const Vec3 ab = corner[1] - corner[0], ac = corner[2] - corner[0];
  const double longest =
      std::max({ab.squaredNorm(), ac.squaredNorm(), (ac - ab).squaredNorm()});
  if (ab.cross(ac).norm() > least_height * longest)
    return;
  std::ostringstream message;
  message << "facet " << facet << " has no area; its height must be more than "
          << least_height << " of its longest side";
  throw std::invalid_argument(message.str());
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

/// FacetTopology::count.
void fill_counts(const FacetSurface &surface, FacetTopology &topology)
{
  const std::size_t n = surface.position.size();
  std::vector<std::int32_t> sides(n, 0); // each shared edge twice
  for (std::size_t k = 0; k < surface.triangles.size(); ++k)
    for (std::size_t which = 0; which < 3; ++which)
      if (topology.neighbour[k][which] >= 0)
        for (const std::size_t end : {which, (which + 1) % 3})
          ++sides[static_cast<std::size_t>(surface.triangles[k][end])];
  topology.count.resize(n);
  for (std::size_t v = 0; v < n; ++v)
    topology.count[v] =
        1 - (topology.row_start[v + 1] - topology.row_start[v]) + sides[v] / 2;
}
} // namespace

FacetTopology::FacetTopology(const FacetSurface &surface)
{
  for (std::size_t facet = 0; facet < surface.triangles.size(); ++facet)
  {
    check_vertices(surface, facet);
    check_area(surface, facet);
  }
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
  fill_counts(surface, *this);
}
} // namespace dem
