#pragma once

#include "membrane_kernel.h"

#include <fem/surface_mesh.h>

#include <memory>
#include <string>

namespace fem
{
/// Nodal fields of one output file, nodes in mesh order.
struct MembraneFields
{
  std::span<const Eigen::Vector3d> position; ///< [m]
  std::span<const Eigen::Vector3d> velocity; ///< [m/s]
  std::span<const Eigen::Vector3d> load;     ///< from outside [N]
};

/// The finite element space of the membrane on deal.II: FESystem(FE_Q(1), 3) on
/// a Triangulation<2, 3>. The only part of this library that includes deal.II.
/// Everything it returns is numbered as the nodes and quads of the mesh.
class MembraneSpace
{
public:
  explicit MembraneSpace(const SurfaceMesh &reference);
  ~MembraneSpace();
  MembraneSpace(MembraneSpace &&) noexcept;

  /// Elements in the order of the quads, outward as the quads are; without
  /// material.
  Sheet make_sheet() const;

  /// int N_v dA by Gauss-Lobatto points: the lumped mass over rho h [m^2].
  std::vector<double> nodal_area() const;

  /// Deformed membrane as .vtu; the caller checks the stream.
  void write_vtu(std::ostream &out, const Sheet &sheet,
                 const MembraneFields &fields) const;

private:
  struct Parts;
  std::unique_ptr<Parts> parts;
};
} // namespace fem
