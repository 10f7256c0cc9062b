#pragma once

#include "solid_state.h"

namespace fem
{
/// M q'' + C q' + K q = (f, 0) on the components of the interface, then the
/// amplitudes of inner modes.
struct ReducedSystem
{
  Eigen::MatrixXd mass;            ///< [kg]
  Eigen::MatrixXd damping;         ///< [kg/s], empty if there is none
  Eigen::MatrixXd stiffness;       ///< of the interface: condensed [N/m]
  Eigen::VectorXd inner_stiffness; ///< omega^2 of the inner modes [1/s^2]
  Eigen::Index size() const { return mass.rows(); }
};

/// Component `c` of interface node `node` as a row of the reduced system.
struct InterfaceRow
{
  std::size_t node = 0; ///< number within the interface
  int component = 0;
  std::int32_t unknown = 0; ///< of the body
};

/// The rows of the free components of these nodes, in their order.
std::vector<InterfaceRow>
interface_rows(const SolidSupports &supports,
               std::span<const std::int32_t> interface);

ReducedSystem reduce(const SolidParts &parts, double stiffness_damping,
                     std::span<const InterfaceRow> rows, int n_inner_modes);
} // namespace fem
