#pragma once

#include <fem/drucker_prager.h>
#include <fem/solid.h>

#include <Eigen/Dense>

#include <array>

namespace fem
{
/// Row and column 3 v + c belong to component c of corner v.
using CellMatrix = Eigen::Matrix<double, 24, 24, Eigen::RowMajor>;
using CellCorners = std::array<Eigen::Vector3d, 8>;

/// Stiffness of the eight-node cell with incompatible modes [N/m]: the
/// trilinear displacement and, inside each cell, 1 - xi^2, 1 - eta^2 and
/// 1 - zeta^2 times nine amplitudes that are eliminated (Wilson 1973). Their
/// gradients are taken with the Jacobian of the centre (Taylor, Beresford,
/// Wilson 1976), so that the patch test holds on any cells. 2 x 2 x 2 Gauss.
/// Where the layer is not linear, mean_dilatation_points in place of the modes.
/// Throws std::invalid_argument where the Jacobian is not positive.
CellMatrix cell_stiffness(const CellCorners &corners, const SolidLayer &layer);

/// Strains of the eight Gauss points per displacement of the corners, with
/// the mean dilatation of the cell in place of that of the point (Hughes 1980),
/// so that plastic flow does not lock.
struct CellPoints
{
  std::array<Eigen::Matrix<double, 6, 24>, 8> strain; ///< [1/m]
  std::array<double, 8> volume{};                     ///< [m^3]
};
/// Of the trilinear functions at the Gauss points.
struct PointGradients
{
  std::array<Eigen::Matrix<double, 8, 3>, 8> gradient; ///< [1/m]
  std::array<double, 8> volume{};                      ///< [m^3]
};
PointGradients point_gradients(const CellCorners &corners);
CellPoints mean_dilatation_points(const CellCorners &corners);
std::array<Eigen::Vector3d, 8>
point_positions(const CellCorners &corners); ///< [m]

/// Lumped masses rho int N_v dV of the corners [kg].
std::array<double, 8> cell_mass(const CellCorners &corners, double density);

/// Stress at the centre, where the incompatible modes have no gradient:
/// xx, yy, zz, yz, zx, xy, tension positive [Pa].
Voigt centre_stress(const CellCorners &corners, const SolidLayer &layer,
                    const std::array<Eigen::Vector3d, 8> &displacement);
} // namespace fem
