#pragma once

#include "solid_operator.h"

#include <fem/drucker_prager.h>
#include <fem/neo_hooke.h>

#include <optional>

namespace fem
{
/// Cells of neo-Hookean layers at finite strains, each with its mean volume
/// change in place of that of the points (Simo, Taylor and Pister 1985).
class HyperCells
{
public:
  HyperCells(const SolidMesh &mesh, std::span<const SolidLayer> layers);
  bool empty() const { return cells.empty(); }

  /// Adds K u - f, what the linear cells give too much [N]. Not
  /// finite where a cell is turned inside out.
  void relieve(std::span<const Eigen::Vector3d> u,
               std::span<Eigen::Vector3d> force) const;
  /// Tangent less K of every cell.
  void soften(std::span<const Eigen::Vector3d> u,
              std::vector<CellChange> &changes) const;
  /// Stored beyond 1/2 u . f with f the internal force [J].
  double stored_beyond(std::span<const Eigen::Vector3d> u) const;
  /// Cauchy stress, mean over a cell of the mesh [Pa]; no value in others.
  std::optional<Voigt> mean_stress(std::size_t cell,
                                   std::span<const Eigen::Vector3d> u) const;

private:
  struct Cell
  {
    std::size_t number = 0; ///< in the mesh
    std::array<std::int32_t, 8> nodes{};
    std::size_t points = 0; ///< entry in shapes
    NeoHooke law;
  };
  struct Shape
  {
    PointGradients points;
    CellMatrix stiffness; ///< K [N/m]
  };
  struct Response;
  Response respond(const Cell &cell, std::span<const Eigen::Vector3d> u) const;

  std::vector<Cell> cells;
  std::vector<std::int32_t> entry; ///< of a cell of the mesh, -1: none
  std::vector<Shape> shapes;
};
} // namespace fem
