#pragma once

#include "solid_operator.h"

#include <fem/drucker_prager.h>

#include <functional>
#include <optional>

namespace fem
{
/// Of the points of all cells that may yield, eight per cell.
struct PlasticState
{
  std::vector<Voigt> strain; ///< plastic [-]
  std::vector<Voigt> stress; ///< beyond the initial one [Pa]
};

/// What the cells of layers with a finite cohesion do beyond Hooke's law.
class PlasticCells
{
public:
  PlasticCells(const SolidMesh &mesh, std::span<const SolidLayer> layers);
  bool empty() const { return cells.empty(); }
  PlasticState start() const; ///< no strain, no stress
  void set_initial_stress(
      const SolidMesh &mesh,
      const std::function<Voigt(const Eigen::Vector3d &)> &stress);
  void add_initial_stress(std::span<const Voigt> stress); ///< of the points
  std::span<Voigt> initial_stress() { return initial; }

  /// Stress and plastic strain at these displacements, from those of the last
  /// step.
  void respond(std::span<const Eigen::Vector3d> u, const PlasticState &last,
               PlasticState &next) const;
  /// Adds what plastic strain takes from K u [N].
  void relieve(const PlasticState &state,
               std::span<Eigen::Vector3d> force) const;

  /// Consistent tangent less the elastic one of every cell that flows on the
  /// way from `last` to these displacements; not symmetric without associated
  /// flow.
  void soften(std::span<const Eigen::Vector3d> u, const PlasticState &last,
              std::vector<CellChange> &changes) const;

  /// Stored beyond 1/2 u . f with f the internal force; of the initial stress
  /// what it has not done in plastic flow [J].
  double stored_beyond(const PlasticState &state) const;
  /// Mean stress, with the initial one, times plastic strain of a step [J].
  double dissipated(const PlasticState &last, const PlasticState &next) const;
  double yielded_share(const PlasticState &state) const; ///< of the volume [-]
  /// Mean over a cell of the mesh [Pa]; no value if it cannot yield.
  std::optional<Voigt> mean_stress(std::size_t cell,
                                   const PlasticState &state) const;

private:
  struct Cell
  {
    std::size_t number = 0; ///< in the mesh
    std::array<std::int32_t, 8> nodes{};
    std::size_t points = 0; ///< entry in shapes
    std::size_t law = 0;
  };
  /// With the initial stress, at a point of a cell of this class.
  Voigt elastic_trial(std::size_t cell, std::size_t point,
                      const Eigen::Matrix<double, 24, 1> &u,
                      const PlasticState &last) const;

  std::vector<Cell> cells;
  std::vector<std::int32_t> entry; ///< of a cell of the mesh, -1: elastic
  std::vector<CellPoints> shapes;
  std::vector<DruckerPrager> laws; ///< by layer
  std::vector<Voigt> initial;      ///< stress of the points [Pa]
};
} // namespace fem
