#include "solid_state.h"

#include <deal.II/base/data_out_base.h>
#include <deal.II/grid/reference_cell.h>

#include <sstream>

namespace fem
{
namespace
{
using Patch = dealii::DataOutBase::Patch<3, 3>;

const std::vector<std::string> names{
    "displacement_m",   "displacement_m",   "displacement_m",
    "velocity_m_per_s", "velocity_m_per_s", "velocity_m_per_s",
    "load_N",           "load_N",           "load_N",
    "stress_xx_Pa",     "stress_yy_Pa",     "stress_zz_Pa",
    "stress_yz_Pa",     "stress_zx_Pa",     "stress_xy_Pa",
    "layer_1"};

/// Every cell by itself: hanging nodes need no care.
Patch make_patch(const SolidMesh &mesh, const SolidFields &fields,
                 std::size_t cell)
{
  Patch patch;
  // Cells of a patch that does not say what it is are left out of the file.
  patch.reference_cell = dealii::ReferenceCells::Hexahedron;
  patch.patch_index = static_cast<unsigned int>(cell);
  patch.data.reinit(static_cast<unsigned int>(names.size()), 8);
  for (unsigned int v = 0; v < 8; ++v)
  {
    const auto node = static_cast<std::size_t>(mesh.cells[cell][v]);
    for (unsigned int c = 0; c < 3; ++c)
    {
      patch.vertices[v][c] = mesh.nodes[node](c);
      patch.data(c, v) = static_cast<float>(fields.displacement[node](c));
      patch.data(3 + c, v) = static_cast<float>(fields.velocity[node](c));
      patch.data(6 + c, v) = static_cast<float>(fields.load[node](c));
    }
    for (unsigned int s = 0; s < 6; ++s)
      patch.data(9 + s, v) = static_cast<float>(fields.stress[cell][s]);
    patch.data(15, v) = static_cast<float>(mesh.layer[cell]);
  }
  return patch;
}
} // namespace

void write_solid_vtu(std::ostream &out, const SolidMesh &mesh,
                     const SolidFields &fields)
{
  std::vector<Patch> patches;
  for (std::size_t k = 0; k < mesh.cells.size(); ++k)
    patches.push_back(make_patch(mesh, fields, k));
  const auto vector =
      dealii::DataComponentInterpretation::component_is_part_of_vector;
  dealii::DataOutBase::VtkFlags flags;
  flags.print_date_and_time = false; // equal runs write equal files
  std::ostringstream text;
  dealii::DataOutBase::write_vtu(patches, names,
                                 {{0, 2, "displacement_m", vector},
                                  {3, 5, "velocity_m_per_s", vector},
                                  {6, 8, "load_N", vector}},
                                 flags, text);
  out << text.view();
}
} // namespace fem
