#include "gmsh_file.h"

#include <fem/triangle_file.h>

#include <stdexcept>
#include <utility>

namespace fem
{
namespace
{
void add_quad(const std::array<std::int32_t, 4> &quad, Triangles &mesh)
{
  const auto length = [&](std::size_t from, std::size_t to)
  {
    return (mesh.nodes[static_cast<std::size_t>(quad[from])] -
            mesh.nodes[static_cast<std::size_t>(quad[to])])
        .squaredNorm();
  };
  const std::size_t k = length(0, 2) <= length(1, 3) ? 0 : 1;
  mesh.corners.push_back({quad[k], quad[k + 1], quad[k + 2]});
  mesh.corners.push_back({quad[k], quad[k + 2], quad[(k + 3) % 4]});
}
} // namespace

Triangles read_triangles(const std::string &path)
{
  GmshMesh file;
  try
  {
    file = read_gmsh(path);
  }
  catch (const std::invalid_argument &fault)
  {
    throw std::invalid_argument(
        path + " is not a gmsh file of triangles: " + fault.what());
  }
  Triangles mesh;
  mesh.nodes = std::move(file.nodes);
  for (const GmshCell<3> &triangle : file.triangles)
    mesh.corners.push_back(triangle.corners);
  for (const GmshCell<4> &quad : file.quads)
    add_quad(quad.corners, mesh);
  if (mesh.corners.empty())
    throw std::invalid_argument(path + " has no triangles or quads");
  return mesh;
}
} // namespace fem
