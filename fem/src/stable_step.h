#pragma once

#include "followers.h"
#include "membrane_kernel.h"

#include <functional>

namespace fem
{
struct SheetInertia
{
  std::span<const double> mass;       ///< of nodes [kg]
  std::span<const std::uint8_t> tied; ///< axes, as MembraneMotion::tied
  const Followers &midpoints;         ///< without mass
};

/// Largest eigenfrequency of the tangent with lumped masses [rad/s], by the
/// Lanczos iteration on M^(-1/2) K M^(-1/2) with the exact tangent, tension and
/// pressure included, on the free nodes; 0 if none is free. The value comes
/// from below; it is iterated until it stands still to 1e-6.
double largest_frequency(const Sheet &sheet, const SheetInertia &inertia,
                         std::span<const Eigen::Vector3d> positions,
                         double pressure);

/// Largest eigenvalue of a symmetric operator on fields of vectors, by Lanczos
/// iteration from `start`, which lies in the space the operator acts in.
using FieldOperator = std::function<std::vector<Eigen::Vector3d>(
    const std::vector<Eigen::Vector3d> &)>;
double largest_eigenvalue(const FieldOperator &apply,
                          std::vector<Eigen::Vector3d> start);

/// A field with some of every mode, the same in every run.
std::vector<Eigen::Vector3d> start_field(std::size_t n_nodes);
} // namespace fem
