#include "gmsh_file.h"

#include <algorithm>
#include <stdexcept>

namespace fem
{
namespace
{
/// Corners of each face of a hexahedron.
constexpr std::array<std::array<std::size_t, 4>, 6> face_corners{
    {{0, 1, 2, 3},
     {4, 5, 6, 7},
     {0, 1, 5, 4},
     {1, 2, 6, 5},
     {2, 3, 7, 6},
     {3, 0, 4, 7}}};

template <std::size_t n>
using Side = std::array<std::int32_t, n>;

template <std::size_t n>
void sort_all(std::vector<Side<n>> &sides)
{
  for (Side<n> &side : sides)
    std::ranges::sort(side);
  std::ranges::sort(sides);
}

/// Of sides that are sorted.
template <std::size_t n>
bool has_three_alike(const std::vector<Side<n>> &sides)
{
  for (std::size_t k = 2; k < sides.size(); ++k)
    if (sides[k] == sides[k - 2])
      return true;
  return false;
}
} // namespace

void check_edges(const std::vector<GmshCell<4>> &quads)
{
  std::vector<Side<2>> edges;
  for (const GmshCell<4> &quad : quads)
    for (std::size_t v = 0; v < 4; ++v)
      edges.push_back({quad.corners[v], quad.corners[(v + 1) % 4]});
  sort_all(edges);
  if (has_three_alike(edges))
    throw std::invalid_argument("an edge belongs to more than two quads");
}

std::vector<GmshCell<4>> surface_quads(const GmshMesh &mesh)
{
  std::vector<Side<4>> faces;
  for (const GmshCell<8> &cell : mesh.hexahedra)
    for (const auto &corners : face_corners)
    {
      Side<4> &face = faces.emplace_back();
      for (std::size_t v = 0; v < 4; ++v)
        face[v] = cell.corners[corners[v]];
    }
  sort_all(faces);
  if (has_three_alike(faces))
    throw std::invalid_argument("a face belongs to more than two hexahedra");
  std::vector<GmshCell<4>> outside;
  for (const GmshCell<4> &quad : mesh.quads)
  {
    Side<4> face = quad.corners;
    std::ranges::sort(face);
    const auto [first, last] =
        std::equal_range(faces.begin(), faces.end(), face);
    if (first == last)
      throw std::invalid_argument("a quad is no face of a hexahedron");
    if (last - first == 1)
      outside.push_back(quad);
  }
  return outside;
}
} // namespace fem
