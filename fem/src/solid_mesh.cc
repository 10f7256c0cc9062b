#include "gmsh_cells.h"

#include <fem/solid_mesh.h>

#include <deal.II/dofs/dof_handler.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/grid/grid_generator.h>
#include <deal.II/grid/tria.h>
#include <deal.II/lac/affine_constraints.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>

namespace fem
{
namespace
{
using Triangulation = dealii::Triangulation<3>;

/// Corners of each face of a cell, counter-clockwise seen from outside.
constexpr std::array<std::array<unsigned int, 4>, 6> face_corners{
    {{0, 4, 6, 2},
     {1, 3, 7, 5},
     {0, 1, 5, 4},
     {2, 6, 7, 3},
     {0, 2, 3, 1},
     {4, 5, 7, 6}}};

/// Numbers of the vertices that the active cells use, -1 for others.
std::vector<std::int32_t> number_vertices(const Triangulation &triangulation,
                                          SolidMesh &mesh)
{
  std::vector<std::int32_t> number(triangulation.n_vertices(), -1);
  for (const auto &cell : triangulation.active_cell_iterators())
    for (const unsigned int v : cell->vertex_indices())
    {
      std::int32_t &node = number[cell->vertex_index(v)];
      if (node >= 0)
        continue;
      node = static_cast<std::int32_t>(mesh.nodes.size());
      const dealii::Point<3> &x = cell->vertex(v);
      mesh.nodes.emplace_back(x[0], x[1], x[2]);
    }
  return number;
}

void add_faces(const Triangulation::active_cell_iterator &cell, SolidMesh &mesh)
{
  for (const unsigned int f : cell->face_indices())
  {
    if (!cell->face(f)->at_boundary())
      continue;
    SolidMesh::Face &face = mesh.faces.emplace_back();
    face.boundary = static_cast<std::int32_t>(cell->face(f)->boundary_id());
    face.cell = static_cast<std::int32_t>(mesh.cells.size()) - 1;
    for (unsigned int v = 0; v < 4; ++v)
      face.corners[v] = mesh.cells.back()[face_corners[f][v]];
  }
}

/// Hanging nodes as constraints of deal.II, in the numbers of the nodes.
void add_hanging(const Triangulation &triangulation,
                 const std::vector<std::int32_t> &number, SolidMesh &mesh)
{
  const dealii::FE_Q<3> element(1);
  dealii::DoFHandler<3> dof_handler(triangulation);
  dof_handler.distribute_dofs(element);
  std::vector<std::int32_t> node(dof_handler.n_dofs());
  for (const auto &cell : dof_handler.active_cell_iterators())
    for (const unsigned int v : cell->vertex_indices())
      node[cell->vertex_dof_index(v, 0)] = number[cell->vertex_index(v)];

  dealii::AffineConstraints<double> constraints;
  dealii::DoFTools::make_hanging_node_constraints(dof_handler, constraints);
  constraints.close();
  for (const auto &line : constraints.get_lines())
  {
    HangingNode &hanging = mesh.hanging.emplace_back();
    hanging.node = node[line.index];
    for (const auto &[dof, weight] : line.entries)
      hanging.parents.emplace_back(node[dof], weight);
  }
}

SolidMesh flatten(const Triangulation &triangulation)
{
  SolidMesh mesh;
  const std::vector<std::int32_t> number = number_vertices(triangulation, mesh);
  for (const auto &cell : triangulation.active_cell_iterators())
  {
    std::array<std::int32_t, 8> &corners = mesh.cells.emplace_back();
    for (const unsigned int v : cell->vertex_indices())
      corners[v] = number[cell->vertex_index(v)];
    mesh.layer.push_back(static_cast<std::int32_t>(cell->material_id()));
    add_faces(cell, mesh);
  }
  add_hanging(triangulation, number, mesh);
  return mesh;
}

bool contains(const RefinedRegion &region, const dealii::Point<3> &x)
{
  for (unsigned int c = 0; c < 3; ++c)
    if (x[c] < region.lower(c) || x[c] > region.upper(c))
      return false;
  return true;
}

void refine(Triangulation &triangulation,
            const std::vector<RefinedRegion> &regions)
{
  bool is_done = regions.empty();
  while (!is_done)
  {
    is_done = true;
    for (const auto &cell : triangulation.active_cell_iterators())
      for (const RefinedRegion &region : regions)
        if (cell->level() < region.level && contains(region, cell->center()))
        {
          cell->set_refine_flag();
          is_done = false;
        }
    triangulation.execute_coarsening_and_refinement();
  }
}

/// Throws std::invalid_argument unless the edges that meet in a corner span a
/// volume of positive sign, in all corners.
void check_cells(const SolidMesh &mesh, const std::string &path)
{
  for (const auto &cell : mesh.cells)
    for (std::size_t v = 0; v < 8; ++v)
    {
      const auto at = [&](std::size_t corner) -> const Eigen::Vector3d &
      { return mesh.nodes[static_cast<std::size_t>(cell[corner])]; };
      Eigen::Matrix3d edges;
      for (std::size_t c = 0; c < 3; ++c)
        edges.col(static_cast<Eigen::Index>(c)) =
            (v >> c & 1 ? -1. : 1.) * (at(v ^ (1u << c)) - at(v));
      if (edges.determinant() > 1e-6 * edges.colwise().norm().prod())
        continue;
      std::ostringstream text;
      text << "solid mesh: " << path << ": a cell is flat or turned inside out "
           << "at its corner (" << at(v).x() << ", " << at(v).y() << ", "
           << at(v).z() << ")";
      throw std::invalid_argument(text.str());
    }
}

[[noreturn]] void refuse(const std::string &path, const std::string &what)
{
  throw std::invalid_argument("solid mesh: " + path + what);
}

/// The hexahedra of the file, with the quads on their surface.
void fill(Triangulation &triangulation, const std::string &path)
{
  if (std::filesystem::is_directory(path))
    refuse(path, " is a folder, must be a gmsh file");
  GmshMesh mesh;
  try
  {
    mesh = read_gmsh(path);
    mesh.quads = surface_quads(mesh);
  }
  catch (const std::invalid_argument &fault)
  {
    refuse(path,
           std::string(" is not a gmsh file of hexahedra: ") + fault.what());
  }
  if (!mesh.triangles.empty())
    mesh.other_cell = "triangles";
  if (mesh.hexahedra.empty() || !mesh.other_cell.empty())
    refuse(path, " has " +
                     (mesh.other_cell.empty() ? "no cells" : mesh.other_cell) +
                     ", all cells must be hexahedra");
  dealii::SubCellData surface; // their material is the boundary's number
  surface.boundary_quads = cell_data<2>(mesh.quads);
  try
  {
    build<3>(mesh.nodes, cell_data<3>(mesh.hexahedra), surface, triangulation);
  }
  catch (const std::exception &)
  {
    refuse(path, " has hexahedra that do not fit together");
  }
}
} // namespace

SolidMesh box_mesh(const BoxMesh &box)
{
  dealii::Point<3> lower, upper;
  for (unsigned int c = 0; c < 3; ++c)
  {
    upper[c] = lower[c] = box.lower(c);
    for (const double width : box.widths[c])
    {
      if (!(width > 0.))
        throw std::invalid_argument(
            "solid mesh: cell width = " + std::to_string(width) +
            " m, must be positive");
      upper[c] += width;
    }
    if (box.widths[c].empty())
      throw std::invalid_argument("solid mesh: no cells along one side");
  }
  Triangulation triangulation;
  const std::vector<std::vector<double>> widths(box.widths.begin(),
                                                box.widths.end());
  dealii::GridGenerator::subdivided_hyper_rectangle(triangulation, widths,
                                                    lower, upper, true);
  for (const auto &cell : triangulation.active_cell_iterators())
    cell->set_material_id(0);
  refine(triangulation, box.refined);
  return flatten(triangulation);
}

SolidMesh read_solid_mesh(const std::string &path)
{
  if (!std::ifstream(path))
    throw std::invalid_argument("solid mesh: cannot open " + path);
  Triangulation triangulation;
  fill(triangulation, path);
  const SolidMesh mesh = flatten(triangulation);
  check_cells(mesh, path);
  return mesh;
}
} // namespace fem
