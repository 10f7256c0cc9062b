#include "membrane_space.h"

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_system.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/fe/mapping_q.h>
#include <deal.II/fe/mapping_q1_eulerian.h>
#include <deal.II/grid/grid_tools.h>
#include <deal.II/grid/tria.h>
#include <deal.II/lac/vector.h>
#include <deal.II/numerics/data_out.h>

#include <algorithm>
#include <sstream>
#include <stdexcept>

namespace fem
{
namespace
{
using dealii::types::global_dof_index;
using Nodes = std::span<const Eigen::Vector3d>;

Eigen::Vector3d to_eigen(const dealii::Tensor<1, 3> &t)
{
  return {t[0], t[1], t[2]};
}

std::array<std::int32_t, 4> sorted(std::array<std::int32_t, 4> nodes)
{
  std::sort(nodes.begin(), nodes.end());
  return nodes;
}

/// deal.II numbers a quad row by row and wants the edges of all cells to run
/// the same way; so the first corner of a cell may differ from the mesh's.
std::vector<dealii::CellData<2>> make_cells(const SurfaceMesh &mesh)
{
  std::vector<dealii::CellData<2>> cells;
  for (const auto &quad : mesh.quads)
  {
    cells.emplace_back(4);
    const std::array<std::size_t, 4> rim{0, 1, 3, 2};
    for (unsigned int v = 0; v < 4; ++v)
      cells.back().vertices[v] = static_cast<unsigned int>(quad[rim[v]]);
  }
  dealii::GridTools::consistently_order_cells(cells);
  return cells;
}

std::vector<dealii::Point<3>> make_vertices(const SurfaceMesh &mesh)
{
  std::vector<dealii::Point<3>> vertices;
  for (const Eigen::Vector3d &x : mesh.nodes)
    vertices.emplace_back(x.x(), x.y(), x.z());
  return vertices;
}

/// Normal of the quad by its diagonals, outward by the order of its rim.
Eigen::Vector3d outward(const SurfaceMesh &mesh, std::size_t quad)
{
  const auto x = [&](std::size_t v)
  { return mesh.nodes[static_cast<std::size_t>(mesh.quads[quad][v])]; };
  return (x(2) - x(0)).cross(x(3) - x(1));
}

/// Orthonormal tangents at one point whose cross product is outward, whatever
/// orientation deal.II gave the cell.
std::array<Eigen::Vector3d, 2>
tangent_frame(const dealii::DerivativeForm<1, 2, 3> &jacobian,
              const Eigen::Vector3d &outside)
{
  Eigen::Vector3d a, b;
  for (unsigned int i = 0; i < 3; ++i)
  {
    a(i) = jacobian[i][0];
    b(i) = jacobian[i][1];
  }
  Eigen::Vector3d normal = a.cross(b).normalized();
  if (normal.dot(outside) < 0.)
    normal = -normal;
  const Eigen::Vector3d first = a.normalized();
  return {first, normal.cross(first)};
}

/// A file per frame is read by people: averages per quad as cell data.
struct CellFields
{
  dealii::Vector<double> area_ratio, tension, energy_density, wrinkled;
};

CellFields cell_fields(const Sheet &sheet, Nodes positions)
{
  const auto n = static_cast<unsigned int>(sheet.elements.size());
  CellFields fields{dealii::Vector<double>(n), dealii::Vector<double>(n),
                    dealii::Vector<double>(n), dealii::Vector<double>(n)};
  for (unsigned int k = 0; k < n; ++k)
  {
    const SheetState state = element_state(sheet, k, positions);
    fields.area_ratio(k) = state.area_ratio;
    fields.tension(k) = state.tension;
    fields.energy_density(k) = state.energy_density;
    fields.wrinkled(k) = state.wrinkled;
  }
  return fields;
}
} // namespace

struct MembraneSpace::Parts
{
  explicit Parts(const SurfaceMesh &reference);

  void number_nodes();
  dealii::Vector<double> to_dofs(Nodes field) const;

  const SurfaceMesh mesh;
  dealii::Triangulation<2, 3> triangulation;
  const dealii::MappingQ<2, 3> mapping;
  const dealii::FESystem<2, 3> element;
  dealii::DoFHandler<2, 3> dof_handler;
  std::vector<std::array<global_dof_index, 3>> dofs; ///< of each node
};

MembraneSpace::Parts::Parts(const SurfaceMesh &reference)
    : mesh(reference), mapping(1), element(dealii::FE_Q<2, 3>(1), 3)
{
  triangulation.create_triangulation(make_vertices(mesh), make_cells(mesh),
                                     dealii::SubCellData());
  dof_handler.reinit(triangulation);
  dof_handler.distribute_dofs(element);
  number_nodes();
}

/// Dofs of every node, and a check that cell k is quad k: all flat arrays rest
/// on it.
void MembraneSpace::Parts::number_nodes()
{
  dofs.resize(mesh.nodes.size());
  for (const auto &cell : dof_handler.active_cell_iterators())
  {
    std::array<std::int32_t, 4> nodes{};
    for (unsigned int v = 0; v < 4; ++v)
    {
      nodes[v] = static_cast<std::int32_t>(cell->vertex_index(v));
      for (unsigned int c = 0; c < 3; ++c)
        dofs[cell->vertex_index(v)][c] = cell->vertex_dof_index(v, c);
    }
    if (sorted(nodes) != sorted(mesh.quads[cell->active_cell_index()]))
      throw std::logic_error("membrane: cells are not in the order of quads");
  }
}

dealii::Vector<double> MembraneSpace::Parts::to_dofs(Nodes field) const
{
  dealii::Vector<double> values(dof_handler.n_dofs());
  for (std::size_t k = 0; k < dofs.size(); ++k)
    for (unsigned int c = 0; c < 3; ++c)
      values(dofs[k][c]) = field[k](c);
  return values;
}

MembraneSpace::MembraneSpace(const SurfaceMesh &reference)
    : parts(std::make_unique<Parts>(reference))
{
}
MembraneSpace::~MembraneSpace() = default;
MembraneSpace::MembraneSpace(MembraneSpace &&) noexcept = default;

Sheet MembraneSpace::make_sheet() const
{
  const dealii::QGauss<2> quadrature(2);
  dealii::FEValues<2, 3> values(
      parts->mapping, parts->element, quadrature,
      dealii::update_values | dealii::update_gradients |
          dealii::update_jacobians | dealii::update_JxW_values);
  Sheet sheet;
  for (const auto &cell : parts->dof_handler.active_cell_iterators())
  {
    values.reinit(cell);
    SheetElement &quad = sheet.elements.emplace_back();
    const Eigen::Vector3d outside =
        outward(parts->mesh, cell->active_cell_index());
    for (unsigned int q = 0; q < 4; ++q)
    {
      quad.point[q].weight = values.JxW(q);
      const auto frame = tangent_frame(values.jacobian(q), outside);
      for (unsigned int v = 0; v < 4; ++v)
      {
        const unsigned int i = parts->element.component_to_system_index(0, v);
        quad.node[v] = static_cast<std::int32_t>(cell->vertex_index(v));
        sheet.value[q][v] = values.shape_value(i, q);
        const Eigen::Vector3d gradient = to_eigen(values.shape_grad(i, q));
        quad.point[q].gradient[v] = {gradient.dot(frame[0]),
                                     gradient.dot(frame[1])};
      }
    }
  }
  return sheet;
}

std::vector<double> MembraneSpace::nodal_area() const
{
  const dealii::QGaussLobatto<2> corners(2);
  dealii::FEValues<2, 3> values(parts->mapping, parts->element, corners,
                                dealii::update_values |
                                    dealii::update_JxW_values);
  std::vector<double> area(parts->mesh.nodes.size(), 0.);
  for (const auto &cell : parts->dof_handler.active_cell_iterators())
  {
    values.reinit(cell);
    for (unsigned int q = 0; q < 4; ++q)
      for (unsigned int v = 0; v < 4; ++v)
        area[cell->vertex_index(v)] +=
            values.JxW(q) *
            values.shape_value(parts->element.component_to_system_index(0, v),
                               q);
  }
  return area;
}

void MembraneSpace::write_vtu(std::ostream &out, const Sheet &sheet,
                              const MembraneFields &fields) const
{
  using Kind = dealii::DataComponentInterpretation::DataComponentInterpretation;
  const std::vector<Kind> vector(
      3, dealii::DataComponentInterpretation::component_is_part_of_vector);
  const dealii::Vector<double> velocity = parts->to_dofs(fields.velocity);
  const dealii::Vector<double> load = parts->to_dofs(fields.load);
  dealii::Vector<double> displacement = parts->to_dofs(fields.position);
  displacement -= parts->to_dofs(parts->mesh.nodes);
  const CellFields cells = cell_fields(sheet, fields.position);

  dealii::DataOut<2, 3> output;
  output.attach_dof_handler(parts->dof_handler);
  const auto add = [&](const auto &data, const std::string &name)
  {
    output.add_data_vector(data, std::vector<std::string>(3, name),
                           dealii::DataOut<2, 3>::type_dof_data, vector);
  };
  add(displacement, "displacement_m");
  add(velocity, "velocity_m_per_s");
  add(load, "load_N");
  output.add_data_vector(cells.area_ratio, "area_ratio_1");
  output.add_data_vector(cells.tension, "tension_N_per_m");
  output.add_data_vector(cells.energy_density, "energy_density_J_per_m2");
  output.add_data_vector(cells.wrinkled, "wrinkled_1");
  const dealii::MappingQ1Eulerian<2, dealii::Vector<double>, 3> deformed(
      parts->dof_handler, displacement);
  output.build_patches(deformed);

  dealii::DataOutBase::VtkFlags flags;
  flags.print_date_and_time = false; // equal runs write equal files
  output.set_flags(flags);
  // deal.II answers a bad stream with a page of text, so it gets a good one.
  std::ostringstream text;
  output.write_vtu(text);
  out << text.view();
}
} // namespace fem
