#pragma once

#include "solid_supports.h"
#include "solid_system.h"

namespace fem
{
/// Conjugate gradients preconditioned by smoothed aggregation with the rigid
/// motions of the nodes as near-null space (Vanek, Mandel and Brezina 1996; ML
/// of Trilinos). Starts MPI if nobody has, alone on its rank.
class MultigridSolver
{
public:
  /// `lower`: symmetric, positive definite, on the unknowns of the supports.
  MultigridSolver(const SparseMatrix &lower, const SolidSupports &supports,
                  std::span<const Eigen::Vector3d> nodes);
  ~MultigridSolver();

  /// Until the residual is `tolerance` times the right-hand side [-]. Throws
  /// std::runtime_error if it does not get there.
  Eigen::VectorXd solve(const Eigen::VectorXd &right_hand_side,
                        double tolerance);
  int n_iterations() const; ///< of the last solve

private:
  struct Hierarchy;
  std::unique_ptr<Hierarchy> hierarchy;
};
} // namespace fem
