#pragma once

#include "solid_operator.h"
#include "solid_supports.h"

#include <Eigen/Sparse>

#include <memory>

namespace fem
{
using SparseMatrix = Eigen::SparseMatrix<double>;
using SparseRows = Eigen::SparseMatrix<double, Eigen::RowMajor>;

/// Everything linear about a body: a sum of these three on its unknowns.
struct SystemWeights
{
  double mass = 0.;
  double dashpot = 0.;
  double stiffness = 0.;
};

/// The parts that the sum is made of.
struct SolidParts
{
  const SolidMesh &mesh;
  const SolidOperator &elastic;
  const SolidSupports &supports;
  std::span<const double> mass; ///< of the nodes that do not hang [kg]
  std::span<const Eigen::Matrix3d> dashpot; ///< of the same nodes [kg/s]
  std::span<const Eigen::Matrix3d>
      bedding; ///< of springs to the ground; empty: none [N/m]
};

/// Lower triangle of the sum, on the unknowns of the supports.
SparseMatrix assemble(const SolidParts &parts, const SystemWeights &weights);

/// All entries of its rows whose unknowns are marked; the others are empty.
SparseRows assemble_rows(const SolidParts &parts, const SystemWeights &weights,
                         std::span<const char> is_marked);

/// The sum of given matrices of some cells, with all entries.
SparseMatrix assemble_cells(const SolidParts &parts,
                            std::span<const CellChange> cells, double weight);

/// Free components of a field in the order of the unknowns, and back; fixed
/// and hanging ones are left as they are.
Eigen::VectorXd to_unknowns(const SolidSupports &supports,
                            std::span<const Eigen::Vector3d> field);
void from_unknowns(const SolidSupports &supports, const Eigen::VectorXd &values,
                   std::span<Eigen::Vector3d> field);

/// By LU factors (UMFPACK) that are not kept. Throws std::runtime_error on a
/// singular matrix.
Eigen::VectorXd solve_once(const SparseMatrix &matrix,
                           const Eigen::VectorXd &right_hand_side);

/// Cholesky factors of a symmetric, positive definite matrix (CHOLMOD,
/// supernodal). Throws std::runtime_error if it is not definite.
class SparseFactor
{
public:
  explicit SparseFactor(const SparseMatrix &lower);
  ~SparseFactor();
  Eigen::MatrixXd solve(const Eigen::MatrixXd &right_hand_sides) const;

private:
  struct Factors;
  std::unique_ptr<Factors> factors;
};
} // namespace fem
