#include "gmsh_cells.h"

#include <fem/surface_file.h>

#include <filesystem>
#include <fstream>
#include <stdexcept>

namespace fem
{
namespace
{
using Triangulation = dealii::Triangulation<2, 3>;

[[noreturn]] void refuse(const std::string &path, const std::string &what)
{
  throw std::invalid_argument("surface mesh: " + path + what);
}

/// The quads of the file, and no other cells.
GmshMesh quads_of(const std::string &path)
{
  if (!std::ifstream(path))
    throw std::invalid_argument("surface mesh: cannot open " + path);
  if (std::filesystem::is_directory(path))
    refuse(path, " is a folder, must be a gmsh file");
  GmshMesh mesh;
  try
  {
    mesh = read_gmsh(path);
    check_edges(mesh.quads);
  }
  catch (const std::invalid_argument &fault)
  {
    refuse(path, std::string(" is not a gmsh file of a surface of quads: ") +
                     fault.what());
  }
  const std::string other = !mesh.triangles.empty()   ? "triangles"
                            : !mesh.hexahedra.empty() ? "hexahedra"
                                                      : mesh.other_cell;
  if (!other.empty())
    refuse(path, " has " + other +
                     ", all cells must be quads: recombine them in gmsh");
  if (mesh.quads.empty())
    refuse(path, " has no quads");
  return mesh;
}

void read(const std::string &path, Triangulation &triangulation)
{
  const GmshMesh mesh = quads_of(path);
  try
  {
    build<2>(mesh.nodes, cell_data<2>(mesh.quads), {}, triangulation);
  }
  catch (const std::exception &)
  {
    refuse(path, " has quads that are no surface");
  }
}
} // namespace

SurfaceMesh read_surface_mesh(const std::string &path)
{
  Triangulation triangulation;
  read(path, triangulation);
  SurfaceMesh mesh;
  std::vector<std::int32_t> number(triangulation.n_vertices(), -1);
  for (const auto &cell : triangulation.active_cell_iterators())
  {
    std::array<unsigned int, 4> rim{0, 1, 3, 2};
    if (!cell->direction_flag())
      std::swap(rim[1], rim[3]);
    auto &quad = mesh.quads.emplace_back();
    for (std::size_t v = 0; v < 4; ++v)
    {
      std::int32_t &node = number[cell->vertex_index(rim[v])];
      if (node < 0)
      {
        node = static_cast<std::int32_t>(mesh.nodes.size());
        const dealii::Point<3> &x = cell->vertex(rim[v]);
        mesh.nodes.emplace_back(x[0], x[1], x[2]);
      }
      quad[v] = node;
    }
  }
  return mesh;
}
} // namespace fem
