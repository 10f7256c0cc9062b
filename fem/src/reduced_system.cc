#include "reduced_system.h"

#include "inner_modes.h"

namespace fem
{
namespace
{
using Eigen::Index;
using Eigen::MatrixXd;

/// A matrix of the body in blocks of the interface (i) and the rest (o).
struct Blocks
{
  SparseMatrix ii, oi, oo; ///< ii and oo: lower triangles
};

/// New index of every unknown: the rows of the interface, or the rest.
struct Numbering
{
  std::vector<bool> is_interface;
  std::vector<int> new_index;
  int n_interface = 0, n_rest = 0;
};

Numbering make_numbering(std::size_t n_unknowns,
                         std::span<const InterfaceRow> rows)
{
  Numbering numbering{std::vector<bool>(n_unknowns, false),
                      std::vector<int>(n_unknowns, 0)};
  for (const InterfaceRow &row : rows)
  {
    const auto k = static_cast<std::size_t>(row.unknown);
    numbering.is_interface[k] = true;
    numbering.new_index[k] = numbering.n_interface++;
  }
  for (std::size_t k = 0; k < n_unknowns; ++k)
    if (!numbering.is_interface[k])
      numbering.new_index[k] = numbering.n_rest++;
  return numbering;
}

Blocks split(const SparseMatrix &lower, const Numbering &numbering)
{
  std::vector<Eigen::Triplet<double>> ii, oi, oo;
  for (int column = 0; column < lower.outerSize(); ++column)
    for (SparseMatrix::InnerIterator entry(lower, column); entry; ++entry)
    {
      const auto r = static_cast<std::size_t>(entry.row());
      const auto c = static_cast<std::size_t>(column);
      const int row = numbering.new_index[r], col = numbering.new_index[c];
      if (numbering.is_interface[r] && numbering.is_interface[c])
        ii.emplace_back(std::max(row, col), std::min(row, col), entry.value());
      else if (numbering.is_interface[c])
        oi.emplace_back(row, col, entry.value());
      else if (numbering.is_interface[r])
        oi.emplace_back(col, row, entry.value());
      else
        oo.emplace_back(std::max(row, col), std::min(row, col), entry.value());
    }
  Blocks blocks{SparseMatrix(numbering.n_interface, numbering.n_interface),
                SparseMatrix(numbering.n_rest, numbering.n_interface),
                SparseMatrix(numbering.n_rest, numbering.n_rest)};
  blocks.ii.setFromTriplets(ii.begin(), ii.end());
  blocks.oi.setFromTriplets(oi.begin(), oi.end());
  blocks.oo.setFromTriplets(oo.begin(), oo.end());
  return blocks;
}

/// Both triangles of a symmetric matrix.
MatrixXd whole(const SparseMatrix &lower)
{
  const SparseMatrix both = lower.selfadjointView<Eigen::Lower>();
  return both;
}

/// T^T A T with T = (1, 0; constraint, inner).
MatrixXd project(const Blocks &a, const MatrixXd &constraint,
                 const MatrixXd &inner)
{
  const Index n = constraint.cols(), m = inner.cols();
  const MatrixXd ac =
      a.oo.selfadjointView<Eigen::Lower>() * constraint; // A_oo Psi
  const MatrixXd ai = a.oo.selfadjointView<Eigen::Lower>() * inner;
  MatrixXd result(n + m, n + m);
  const MatrixXd mixed = a.oi.transpose() * constraint;
  result.topLeftCorner(n, n) =
      whole(a.ii) + mixed + mixed.transpose() + constraint.transpose() * ac;
  result.topRightCorner(n, m) =
      a.oi.transpose() * inner + constraint.transpose() * ai;
  result.bottomLeftCorner(m, n) = result.topRightCorner(n, m).transpose();
  result.bottomRightCorner(m, m) = inner.transpose() * ai;
  return result;
}

/// Psi = -K_oo^(-1) K_oi, 64 columns at a time.
MatrixXd constraint_modes(const SparseFactor &inside, const SparseMatrix &oi)
{
  MatrixXd modes(oi.rows(), oi.cols());
  for (Index first = 0; first < oi.cols(); first += 64)
  {
    const Index width = std::min<Index>(64, oi.cols() - first);
    modes.middleCols(first, width) =
        -inside.solve(MatrixXd(oi.middleCols(first, width)));
  }
  return modes;
}

Eigen::VectorXd rest_mass(const SolidParts &parts, const Numbering &numbering)
{
  Eigen::VectorXd mass(numbering.n_rest);
  for (std::size_t k = 0; k < parts.mass.size(); ++k)
    for (int c = 0; c < 3; ++c)
    {
      const std::int32_t unknown = parts.supports.unknown(k, c);
      if (unknown >= 0 &&
          !numbering.is_interface[static_cast<std::size_t>(unknown)])
        mass(numbering.new_index[static_cast<std::size_t>(unknown)]) =
            parts.mass[k];
    }
  return mass;
}
} // namespace

std::vector<InterfaceRow>
interface_rows(const SolidSupports &supports,
               std::span<const std::int32_t> interface)
{
  std::vector<InterfaceRow> rows;
  for (std::size_t k = 0; k < interface.size(); ++k)
    for (int c = 0; c < 3; ++c)
      if (const std::int32_t unknown =
              supports.unknown(static_cast<std::size_t>(interface[k]), c);
          unknown >= 0)
        rows.push_back({k, c, unknown});
  return rows;
}

ReducedSystem reduce(const SolidParts &parts, double stiffness_damping,
                     std::span<const InterfaceRow> rows, int n_inner_modes)
{
  const Numbering numbering = make_numbering(parts.supports.n_unknowns(), rows);
  const Blocks stiffness = split(assemble(parts, {0., 0., 1.}), numbering);
  const SparseFactor inside(stiffness.oo);
  const MatrixXd constraint = constraint_modes(inside, stiffness.oi);
  InnerModes inner;
  inner.shapes = MatrixXd(numbering.n_rest, 0);
  if (n_inner_modes > 0)
    inner = slowest_modes(inside, rest_mass(parts, numbering), n_inner_modes);

  ReducedSystem system;
  system.mass = project(split(assemble(parts, {1., 0., 0.}), numbering),
                        constraint, inner.shapes);
  system.stiffness =
      whole(stiffness.ii) + stiffness.oi.transpose() * constraint;
  system.stiffness =
      0.5 * (system.stiffness + system.stiffness.transpose()).eval();
  system.inner_stiffness = inner.frequencies.cwiseAbs2();
  MatrixXd damping = project(split(assemble(parts, {0., 1., 0.}), numbering),
                             constraint, inner.shapes);
  const Index n = numbering.n_interface, m = inner.shapes.cols();
  damping.topLeftCorner(n, n) += stiffness_damping * system.stiffness;
  damping.bottomRightCorner(m, m).diagonal() +=
      stiffness_damping * system.inner_stiffness;
  if (damping.cwiseAbs().maxCoeff() > 0.)
    system.damping = damping;
  return system;
}
} // namespace fem
