#pragma once

#include "solid_supports.h"
#include "solid_system.h"

#include <memory>

namespace fem
{
/// Conjugate gradients preconditioned by smoothed aggregation with the rigid
/// motions of the nodes as near-null space (Vanek, Mandel and Brezina 1996; ML
/// of Trilinos). Starts MPI if nobody has, alone on its rank.
class MultigridSolver
{
public:
  /// On one rank alone, or with rows and hierarchy spread over all ranks: then
  /// every rank gives the same body, and all calls are collective.
  enum class Spread
  {
    one_rank,
    all_ranks
  };

  /// The sum with these weights must be positive definite on the unknowns.
  MultigridSolver(const SolidParts &parts, const SystemWeights &weights,
                  Spread spread);
  ~MultigridSolver();

  /// All unknowns, on every rank, for the same right-hand side on every rank.
  /// Iterates until the residual is `tolerance` times the right-hand side [-].
  /// Throws std::runtime_error if it does not get there.
  Eigen::VectorXd solve(const Eigen::VectorXd &right_hand_side,
                        double tolerance);
  int n_iterations() const; ///< of the last solve

private:
  struct Hierarchy;
  std::unique_ptr<Hierarchy> hierarchy;
};
} // namespace fem
