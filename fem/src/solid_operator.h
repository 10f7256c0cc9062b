#pragma once

#include "cell_batches.h"
#include "solid_element.h"

#include <fem/solid_mesh.h>

#include <span>
#include <vector>

namespace fem
{
using NodeField = std::vector<Eigen::Vector3d>;

/// Something added to the matrix of a cell of the mesh.
struct CellChange
{
  std::size_t cell = 0;
  CellMatrix stiffness; ///< [N/m]
};

CellCorners corners_of(const SolidMesh &mesh, std::size_t cell);

/// Two cells share a matrix if this is equal: the layer and the edges from
/// the first corner in units of a billionth of the cell.
using ShapeKey = std::array<std::int64_t, 23>;
ShapeKey shape_key(const CellCorners &corners, std::int32_t layer);

/// Stiffness and lumped mass of a body, cell by cell. Cells of the same
/// shape, size and layer share one matrix; nothing here knows of supports or
/// hanging nodes.
class SolidOperator
{
public:
  SolidOperator(const SolidMesh &mesh, std::span<const SolidLayer> layers);

  /// out = K u [N]
  void multiply(std::span<const Eigen::Vector3d> u,
                std::span<Eigen::Vector3d> out) const;

  const CellMatrix &stiffness(std::size_t cell) const
  {
    return matrices[static_cast<std::size_t>(matrix_of_cell[cell])];
  }
  std::span<const double> mass() const { return nodal_mass; } ///< [kg]

  /// Largest eigenvalue of any single cell, K_e x = omega^2 M_e x: no mode of
  /// the body is faster (Irons and Treharne 1971).
  struct FastestCell
  {
    double frequency = 0.; ///< omega [1/s]
    std::size_t cell = 0;
  };
  FastestCell fastest_cell() const { return fastest; }

private:
  void build_matrices(const SolidMesh &mesh,
                      std::span<const SolidLayer> layers);
  void build_batches(const SolidMesh &mesh);
  void multiply_batch(const CellBatch &batch,
                      std::span<const Eigen::Vector3d> u,
                      std::span<Eigen::Vector3d> out) const;
  void multiply_single(std::size_t cell, std::span<const Eigen::Vector3d> u,
                       std::span<Eigen::Vector3d> out) const;

  std::vector<std::array<std::int32_t, 8>> cells;
  std::vector<CellMatrix> matrices;
  std::vector<std::int32_t> matrix_of_cell;
  std::vector<CellBatch> batches;
  std::vector<std::size_t> singles; ///< cells that fill no batch
  std::vector<double> nodal_mass;
  FastestCell fastest;
  CellKernel kernel;
};
} // namespace fem
