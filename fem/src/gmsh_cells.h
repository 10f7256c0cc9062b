#pragma once

#include "gmsh_file.h"

#include <deal.II/grid/grid_tools.h>
#include <deal.II/grid/tria.h>

namespace fem
{
/// Cells or faces for deal.II, which has another order of the corners.
template <int dim, std::size_t n>
std::vector<dealii::CellData<dim>>
cell_data(const std::vector<GmshCell<n>> &cells)
{
  std::vector<dealii::CellData<dim>> all;
  all.reserve(cells.size());
  for (const GmshCell<n> &cell : cells)
  {
    dealii::CellData<dim> &data = all.emplace_back(n);
    for (unsigned int v = 0; v < n; ++v)
      data.vertices[dealii::GeometryInfo<dim>::ucd_to_deal[v]] =
          static_cast<unsigned int>(cell.corners[v]);
    data.material_id = static_cast<dealii::types::material_id>(cell.physical);
  }
  return all;
}

inline std::vector<dealii::Point<3>>
points_of(const std::vector<Eigen::Vector3d> &nodes)
{
  std::vector<dealii::Point<3>> points;
  points.reserve(nodes.size());
  for (const Eigen::Vector3d &node : nodes)
    points.emplace_back(node.x(), node.y(), node.z());
  return points;
}

/// Cells of one kind as a mesh of deal.II. Throws what deal.II throws.
template <int dim>
void build(const std::vector<Eigen::Vector3d> &nodes,
           std::vector<dealii::CellData<dim>> cells,
           dealii::SubCellData subcells,
           dealii::Triangulation<dim, 3> &triangulation)
{
  std::vector<dealii::Point<3>> points = points_of(nodes);
  dealii::GridTools::delete_unused_vertices(points, cells, subcells);
  if constexpr (dim == 3)
    dealii::GridTools::invert_cells_with_negative_measure(points, cells);
  dealii::GridTools::consistently_order_cells(cells);
  triangulation.create_triangulation(points, cells, subcells);
}
} // namespace fem
