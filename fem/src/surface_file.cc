#include <fem/surface_file.h>

#include <deal.II/grid/grid_in.h>
#include <deal.II/grid/tria.h>

#include <fstream>
#include <stdexcept>

namespace fem
{
namespace
{
using Triangulation = dealii::Triangulation<2, 3>;

void read(const std::string &path, Triangulation &triangulation)
{
  std::ifstream file(path);
  if (!file)
    throw std::invalid_argument("surface mesh: cannot open " + path);
  dealii::GridIn<2, 3> reader(triangulation);
  try
  {
    reader.read_msh(file);
  }
  catch (const std::exception &)
  {
    throw std::invalid_argument("surface mesh: " + path +
                                " is no gmsh file of a surface of quads, each "
                                "edge on at most two of them");
  }
  if (!triangulation.all_reference_cells_are_hyper_cube())
    throw std::invalid_argument("surface mesh: " + path +
                                " has triangles, all cells must be quads: "
                                "recombine them in gmsh");
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
