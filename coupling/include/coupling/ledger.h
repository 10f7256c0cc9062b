#pragma once

#include <Eigen/Dense>

namespace coupling
{
/// What crossed an interface, measured on the side of the particles and on
/// the side of the bodies. Plain data for the checkpoint.
struct LedgerSums
{
  double given = 0., taken = 0.; ///< work [J]
  double moved = 0.;             ///< sum of |work given| over the windows [J]
  Eigen::Vector3d impulse_given = Eigen::Vector3d::Zero(); ///< [N s]
  Eigen::Vector3d impulse_taken = Eigen::Vector3d::Zero(); ///< [N s]
  double impulse_moved = 0.; ///< sum of |impulse given| over the windows [N s]

  /// Work that got lost or was made on the way, over all that crossed [-].
  double work_residual() const { return share(given - taken, moved); }
  double impulse_residual() const
  {
    return share((impulse_given - impulse_taken).norm(), impulse_moved);
  }

private:
  /// Nothing of nothing is no residual.
  static double share(double part, double whole)
  {
    return part == 0. ? 0. : std::abs(part) / whole;
  }
};
} // namespace coupling
