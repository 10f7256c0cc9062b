#include "solid_system.h"

#include <Eigen/CholmodSupport>
#include <Eigen/UmfPackSupport>

#include <algorithm>
#include <stdexcept>

namespace fem
{
namespace
{
using Triplets = std::vector<Eigen::Triplet<double>>;
using Shares = std::vector<SolidSupports::Share>;

/// Entries of a matrix that are asked for.
struct IsLower
{
  bool operator()(std::int32_t row, std::int32_t column) const
  {
    return row >= column;
  }
};

struct IsInMarkedRow
{
  std::span<const char> is_marked; ///< of each unknown
  bool operator()(std::int32_t row, std::int32_t) const
  {
    return is_marked[static_cast<std::size_t>(row)] != 0;
  }
};

template <typename IsAsked>
void add_product(const Shares &rows, const Shares &columns, double value,
                 const IsAsked &is_asked, Triplets &entries)
{
  for (const auto &row : rows)
    for (const auto &column : columns)
      if (is_asked(row.unknown, column.unknown))
        entries.emplace_back(row.unknown, column.unknown,
                             value * row.weight * column.weight);
}

std::array<Shares, 24> cell_shares(const SolidParts &parts, std::size_t cell)
{
  std::array<Shares, 24> shares;
  for (std::size_t i = 0; i < 24; ++i)
    shares[i] = parts.supports.shares(
        static_cast<std::size_t>(parts.mesh.cells[cell][i / 3]),
        static_cast<int>(i % 3));
  return shares;
}

template <typename IsAsked>
void add_cell(const SolidParts &parts, std::size_t cell, double weight,
              const IsAsked &is_asked, Triplets &entries)
{
  const CellMatrix &stiffness = parts.elastic.stiffness(cell);
  const std::array<Shares, 24> shares = cell_shares(parts, cell);
  for (std::size_t i = 0; i < 24; ++i)
    for (std::size_t j = 0; j < 24; ++j)
      add_product(shares[i], shares[j],
                  weight * stiffness(static_cast<Eigen::Index>(i),
                                     static_cast<Eigen::Index>(j)),
                  is_asked, entries);
}

template <typename IsAsked>
void add_node(const SolidParts &parts, std::size_t node,
              const SystemWeights &weights, const IsAsked &is_asked,
              Triplets &entries)
{
  Eigen::Matrix3d sum =
      weights.mass * parts.mass[node] * Eigen::Matrix3d::Identity() +
      weights.dashpot * parts.dashpot[node];
  if (!parts.bedding.empty())
    sum += weights.stiffness * parts.bedding[node];
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
    {
      const std::int32_t row = parts.supports.unknown(node, i);
      const std::int32_t column = parts.supports.unknown(node, j);
      if (row >= 0 && column >= 0 && is_asked(row, column))
        entries.emplace_back(row, column, sum(i, j));
    }
}

/// Whether a node, or a parent of one that hangs, has an unknown with a mark.
std::vector<char> marked_nodes(const SolidParts &parts,
                               std::span<const char> is_marked)
{
  const SolidSupports &supports = parts.supports;
  std::vector<char> result(parts.mesh.nodes.size(), 0);
  const auto has_mark = [&](std::size_t node)
  {
    for (int c = 0; c < 3; ++c)
      if (const std::int32_t unknown = supports.unknown(node, c);
          unknown >= 0 && is_marked[static_cast<std::size_t>(unknown)])
        return true;
    return false;
  };
  for (std::size_t k = 0; k < result.size(); ++k)
    if (!supports.is_hanging(k))
      result[k] = has_mark(k);
    else
      for (const auto &[parent, weight] : supports.parents(k))
        if (has_mark(static_cast<std::size_t>(parent)))
          result[k] = 1;
  return result;
}

template <typename Action>
void for_each_unknown(const SolidSupports &supports, std::size_t n_nodes,
                      const Action &action)
{
  for (std::size_t k = 0; k < n_nodes; ++k)
    for (int c = 0; c < 3; ++c)
      if (const std::int32_t unknown = supports.unknown(k, c); unknown >= 0)
        action(unknown, k, c);
}
} // namespace

SparseMatrix assemble(const SolidParts &parts, const SystemWeights &weights)
{
  Triplets entries;
  entries.reserve(300 * parts.mesh.cells.size() + 6 * parts.mesh.nodes.size());
  for (std::size_t k = 0; k < parts.mesh.cells.size(); ++k)
    add_cell(parts, k, weights.stiffness, IsLower(), entries);
  for (std::size_t k = 0; k < parts.mesh.nodes.size(); ++k)
    add_node(parts, k, weights, IsLower(), entries);
  const auto n = static_cast<Eigen::Index>(parts.supports.n_unknowns());
  SparseMatrix matrix(n, n);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

SparseRows assemble_rows(const SolidParts &parts, const SystemWeights &weights,
                         std::span<const char> is_marked)
{
  const IsInMarkedRow is_asked{is_marked};
  const std::vector<char> is_near = marked_nodes(parts, is_marked);
  Triplets entries;
  for (std::size_t k = 0; k < parts.mesh.cells.size(); ++k)
    if (std::ranges::any_of(parts.mesh.cells[k],
                            [&](std::int32_t node) {
                              return is_near[static_cast<std::size_t>(node)];
                            }))
      add_cell(parts, k, weights.stiffness, is_asked, entries);
  for (std::size_t k = 0; k < parts.mesh.nodes.size(); ++k)
    if (is_near[k])
      add_node(parts, k, weights, is_asked, entries);
  const auto n = static_cast<Eigen::Index>(parts.supports.n_unknowns());
  SparseRows rows(n, n);
  rows.setFromTriplets(entries.begin(), entries.end());
  return rows;
}

SparseMatrix assemble_cells(const SolidParts &parts,
                            std::span<const CellChange> cells, double weight)
{
  Triplets entries;
  entries.reserve(600 * cells.size());
  for (const auto &[cell, stiffness] : cells)
  {
    const std::array<Shares, 24> shares = cell_shares(parts, cell);
    for (std::size_t i = 0; i < 24; ++i)
      for (std::size_t j = 0; j < 24; ++j)
        for (const auto &row : shares[i])
          for (const auto &column : shares[j])
            entries.emplace_back(row.unknown, column.unknown,
                                 weight * row.weight * column.weight *
                                     stiffness(static_cast<Eigen::Index>(i),
                                               static_cast<Eigen::Index>(j)));
  }
  const auto n = static_cast<Eigen::Index>(parts.supports.n_unknowns());
  SparseMatrix matrix(n, n);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

Eigen::VectorXd solve_once(const SparseMatrix &matrix,
                           const Eigen::VectorXd &right_hand_side)
{
  const Eigen::UmfPackLU<SparseMatrix> factors(matrix);
  if (factors.info() != Eigen::Success)
    throw std::runtime_error("solid: the tangent of its layers that yield is "
                             "singular: they bear no more load");
  return factors.solve(right_hand_side);
}

Eigen::VectorXd to_unknowns(const SolidSupports &supports,
                            std::span<const Eigen::Vector3d> field)
{
  Eigen::VectorXd values(static_cast<Eigen::Index>(supports.n_unknowns()));
  for_each_unknown(supports, field.size(),
                   [&](std::int32_t unknown, std::size_t k, int c)
                   { values(unknown) = field[k](c); });
  return values;
}

void from_unknowns(const SolidSupports &supports, const Eigen::VectorXd &values,
                   std::span<Eigen::Vector3d> field)
{
  for_each_unknown(supports, field.size(),
                   [&](std::int32_t unknown, std::size_t k, int c)
                   { field[k](c) = values(unknown); });
}

struct SparseFactor::Factors
{
  Eigen::CholmodSupernodalLLT<SparseMatrix, Eigen::Lower> cholesky;
};

SparseFactor::SparseFactor(const SparseMatrix &lower)
    : factors(std::make_unique<Factors>())
{
  factors->cholesky.cholmod().print = 0; // what is wrong is thrown
  factors->cholesky.compute(lower);
  if (factors->cholesky.info() != Eigen::Success)
    throw std::runtime_error("solid: the matrix of its " +
                             std::to_string(lower.rows()) +
                             " unknowns is not positive definite: do the "
                             "supports hold the body?");
}
SparseFactor::~SparseFactor() = default;

Eigen::MatrixXd
SparseFactor::solve(const Eigen::MatrixXd &right_hand_sides) const
{
  return factors->cholesky.solve(right_hand_sides);
}
} // namespace fem
