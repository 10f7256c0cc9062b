#pragma once

#include "solid_system.h"

namespace fem
{
struct InnerModes
{
  Eigen::MatrixXd shapes;      ///< columns, orthonormal with the mass
  Eigen::VectorXd frequencies; ///< [rad/s], ascending
};

/// The slowest modes K x = omega^2 M x of a definite K and a diagonal M > 0,
/// by Lanczos iteration with K^(-1) and full orthogonalisation.
InnerModes slowest_modes(const SparseFactor &stiffness,
                         const Eigen::VectorXd &mass, int n_modes);
} // namespace fem
