#include "inner_modes.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <random>

namespace fem
{
namespace
{
/// Orthonormal columns of the iteration so far.
class Basis
{
public:
  Basis(Eigen::Index n_rows, Eigen::Index n_columns)
      : columns(n_rows, n_columns)
  {
  }

  /// The part of `vector` that is new; another one if nothing of it is.
  void append(Eigen::VectorXd vector)
  {
    make_new(vector);
    while (!(vector.norm() > 1e-10))
    {
      for (double &entry : vector)
        entry = static_cast<double>(generator()) / generator.max() - 0.5;
      vector.normalize();
      make_new(vector);
    }
    columns.col(n_used++) = vector.normalized();
  }

  bool is_full() const { return n_used == columns.cols(); }
  Eigen::Index size() const { return n_used; }
  const Eigen::MatrixXd &matrix() const { return columns; }

private:
  void make_new(Eigen::VectorXd &vector) const
  {
    for (int pass = 0; pass < 2; ++pass) // twice for round-off
      vector -= columns.leftCols(n_used) *
                (columns.leftCols(n_used).transpose() * vector);
  }

  Eigen::MatrixXd columns;
  Eigen::Index n_used = 0;
  std::mt19937 generator{1}; ///< the same in every run
};

/// Eight columns at once: modes of equal frequency, as symmetric bodies have
/// them, are found together, and the factors are read once for all.
constexpr Eigen::Index block_size = 8;
} // namespace

InnerModes slowest_modes(const SparseFactor &stiffness,
                         const Eigen::VectorXd &mass, int n_modes)
{
  const Eigen::Index n = mass.size();
  const Eigen::Index n_wanted = std::min<Eigen::Index>(n_modes, n);
  const Eigen::Index n_columns = std::min(n, 2 * n_wanted + 10 * block_size);
  const auto root = mass.cwiseSqrt().asDiagonal();
  Basis basis(n, n_columns);
  Eigen::MatrixXd image(n, n_columns);
  Eigen::MatrixXd next = Eigen::MatrixXd::Zero(n, block_size); // any start
  while (!basis.is_full())
  {
    const Eigen::Index first = basis.size();
    const Eigen::Index width = std::min(block_size, n_columns - first);
    for (Eigen::Index k = 0; k < width; ++k)
      basis.append(next.col(k));
    const Eigen::MatrixXd scaled =
        root * basis.matrix().middleCols(first, width);
    image.middleCols(first, width) = root * stiffness.solve(scaled);
    next.leftCols(width) = image.middleCols(first, width);
    next.colwise().normalize();
  }
  const Eigen::MatrixXd projected = basis.matrix().transpose() * image;
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(
      0.5 * (projected + projected.transpose()));
  InnerModes modes;
  modes.frequencies =
      solver.eigenvalues().reverse().head(n_wanted).cwiseInverse().cwiseSqrt();
  modes.shapes = mass.cwiseSqrt().cwiseInverse().asDiagonal() *
                 (basis.matrix() *
                  solver.eigenvectors().rowwise().reverse().leftCols(n_wanted));
  return modes;
}
} // namespace fem
