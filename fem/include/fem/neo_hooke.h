#pragma once

#include <Eigen/Dense>

namespace fem
{
/// W = mu / 2 (J^(-2/3) tr(F^T F) - 3) + K / 2 ((J^2 - 1) / 2 - ln J), J = det
/// F (Simo 1988): shape and volume apart, so that a cell may take its mean
/// volume change.
struct NeoHooke
{
  double shear_modulus = 0.; ///< mu [Pa]
  double bulk_modulus = 0.;  ///< K [Pa]
};

/// The share of the shape [J/m^3].
double shape_energy(const NeoHooke &law, const Eigen::Matrix3d &deformation);
/// Its first Piola-Kirchhoff stress, mu J^(-2/3) (F - tr(F^T F) / 3 F^(-T))
/// [Pa].
Eigen::Matrix3d shape_stress(const NeoHooke &law,
                             const Eigen::Matrix3d &deformation);
/// Derivative of that along a change of F [Pa].
Eigen::Matrix3d shape_stress_change(const NeoHooke &law,
                                    const Eigen::Matrix3d &deformation,
                                    const Eigen::Matrix3d &change);

/// The share of the volume at a ratio J > 0 [J/m^3], its derivative, mean
/// Cauchy stress K / 2 (J - 1 / J) [Pa], and the derivative of that [Pa].
double volume_energy(const NeoHooke &law, double ratio);
double volume_stress(const NeoHooke &law, double ratio);
double volume_stiffness(const NeoHooke &law, double ratio);
} // namespace fem
