#include "multigrid.h"

#include <Epetra_CrsMatrix.h>
#include <Epetra_Map.h>
#include <Epetra_MpiComm.h>
#include <Epetra_Vector.h>
#include <mpi.h>

#include <cstdlib>
#include <ml_MultiLevelPreconditioner.h>
#include <optional>
#include <stdexcept>

namespace fem
{
namespace
{
constexpr int max_iterations = 1000;

/// ML needs MPI even on one rank; whoever starts it ends it.
void start_mpi_once()
{
  int is_running = 0;
  MPI_Initialized(&is_running);
  if (is_running)
    return;
  MPI_Init(nullptr, nullptr);
  std::atexit(
      []
      {
        int is_over = 0;
        MPI_Finalized(&is_over);
        if (!is_over)
          MPI_Finalize();
      });
}

/// Three rows for every node that has an unknown, as aggregation by nodes wants
/// it: a fixed component is a row of its own.
struct NodeRows
{
  std::vector<int> row_of_unknown;
  std::vector<std::size_t> node; ///< of each triple of rows
  int size() const { return 3 * static_cast<int>(node.size()); }
};

NodeRows make_rows(const SolidSupports &supports, std::size_t n_nodes)
{
  NodeRows rows;
  rows.row_of_unknown.resize(supports.n_unknowns());
  for (std::size_t k = 0; k < n_nodes; ++k)
  {
    bool has_unknown = false;
    for (int c = 0; c < 3; ++c)
      if (const std::int32_t unknown = supports.unknown(k, c); unknown >= 0)
      {
        rows.row_of_unknown[static_cast<std::size_t>(unknown)] =
            rows.size() + c;
        has_unknown = true;
      }
    if (has_unknown)
      rows.node.push_back(k);
  }
  return rows;
}

/// Fixed components get the largest diagonal entry of their node.
std::vector<double> lone_diagonal(const NodeRows &rows,
                                  const SparseMatrix &lower)
{
  std::vector<double> diagonal(static_cast<std::size_t>(rows.size()), 0.);
  std::vector<double> largest(rows.node.size(), 0.);
  for (Eigen::Index j = 0; j < lower.cols(); ++j)
  {
    const int row = rows.row_of_unknown[static_cast<std::size_t>(j)];
    const double value = lower.coeff(j, j);
    diagonal[static_cast<std::size_t>(row)] = value;
    double &node = largest[static_cast<std::size_t>(row / 3)];
    node = std::max(node, value);
  }
  for (std::size_t k = 0; k < diagonal.size(); ++k)
    diagonal[k] = diagonal[k] == 0. ? largest[k / 3] : 0.;
  return diagonal;
}

/// Translations and rotations about the middle of the nodes, one after the
/// other.
std::vector<double> rigid_motions(const NodeRows &rows,
                                  std::span<const Eigen::Vector3d> nodes)
{
  const auto n = static_cast<std::size_t>(rows.size());
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  for (const std::size_t node : rows.node)
    middle += nodes[node] / static_cast<double>(rows.node.size());
  std::vector<double> motions(6 * n, 0.);
  for (std::size_t k = 0; k < rows.node.size(); ++k)
  {
    const Eigen::Vector3d x = nodes[rows.node[k]] - middle;
    for (std::size_t c = 0; c < 3; ++c)
    {
      motions[c * n + 3 * k + c] = 1.;
      const Eigen::Vector3d turned =
          Eigen::Vector3d::Unit(static_cast<Eigen::Index>(c)).cross(x);
      for (std::size_t d = 0; d < 3; ++d)
        motions[(3 + c) * n + 3 * k + d] = turned(static_cast<Eigen::Index>(d));
    }
  }
  return motions;
}
} // namespace

struct MultigridSolver::Hierarchy
{
  Hierarchy(const SparseMatrix &lower, const SolidSupports &supports,
            std::span<const Eigen::Vector3d> nodes)
      : rows(make_rows(supports, nodes.size())),
        motions(rigid_motions(rows, nodes)), communicator(MPI_COMM_SELF),
        map(rows.size(), 0, communicator), matrix(Copy, map, 81)
  {
    fill(lower);
    coarsen();
  }

  void fill(const SparseMatrix &lower)
  {
    const SparseMatrix whole = lower.selfadjointView<Eigen::Lower>();
    std::vector<int> columns;
    for (int j = 0; j < whole.outerSize(); ++j) // symmetric: column is row
    {
      columns.clear();
      for (SparseMatrix::InnerIterator entry(whole, j); entry; ++entry)
        columns.push_back(
            rows.row_of_unknown[static_cast<std::size_t>(entry.row())]);
      const int first = whole.outerIndexPtr()[j];
      matrix.InsertGlobalValues(
          rows.row_of_unknown[static_cast<std::size_t>(j)],
          static_cast<int>(columns.size()), whole.valuePtr() + first,
          columns.data());
    }
    const std::vector<double> lone = lone_diagonal(rows, lower);
    for (int row = 0; row < rows.size(); ++row)
      if (const double value = lone[static_cast<std::size_t>(row)]; value > 0.)
        matrix.InsertGlobalValues(row, 1, &value, &row);
    matrix.FillComplete();
    matrix.OptimizeStorage();
  }

  /// No entry is dropped: where inertia rules, all would be.
  void coarsen()
  {
    Teuchos::ParameterList list;
    ML_Epetra::SetDefaults("SA", list);
    list.set("ML output", 0);
    list.set("PDE equations", 3);
    list.set("aggregation: threshold", 0.);
    list.set("eigen-analysis: type", "Anorm"); // no random start
    list.set("smoother: type", "Chebyshev");
    list.set("smoother: sweeps", 2);
    list.set("coarse: type", "Amesos-KLU");
    list.set("coarse: max size", 1000);
    list.set("null space: type", "pre-computed");
    list.set("null space: dimension", 6);
    list.set("null space: vectors", motions.data());
    preconditioner.emplace(matrix, list, true);
  }

  const NodeRows rows;
  std::vector<double> motions;
  const Epetra_MpiComm communicator;
  const Epetra_Map map;
  Epetra_CrsMatrix matrix;
  std::optional<ML_Epetra::MultiLevelPreconditioner> preconditioner;
  int n_iterations = 0;
};

MultigridSolver::MultigridSolver(const SparseMatrix &lower,
                                 const SolidSupports &supports,
                                 std::span<const Eigen::Vector3d> nodes)
{
  start_mpi_once();
  hierarchy = std::make_unique<Hierarchy>(lower, supports, nodes);
}
MultigridSolver::~MultigridSolver() = default;

Eigen::VectorXd MultigridSolver::solve(const Eigen::VectorXd &right_hand_side,
                                       double tolerance)
{
  Hierarchy &h = *hierarchy;
  Epetra_Vector x(h.map), r(h.map), z(h.map), p(h.map), q(h.map);
  for (Eigen::Index k = 0; k < right_hand_side.size(); ++k)
    r[h.rows.row_of_unknown[static_cast<std::size_t>(k)]] = right_hand_side(k);
  const double limit = tolerance * right_hand_side.norm();
  double residual = right_hand_side.norm(), rz = 0.;
  for (h.n_iterations = 0; residual > limit; ++h.n_iterations)
  {
    if (h.n_iterations == max_iterations)
      throw std::runtime_error(
          "solid: conjugate gradients leave " +
          std::to_string(1e6 * residual / right_hand_side.norm()) +
          "e-6 of the load after " + std::to_string(max_iterations) +
          " iterations: do the supports hold the body?");
    h.preconditioner->ApplyInverse(r, z);
    const double before = rz;
    r.Dot(z, &rz);
    p.Update(1., z, h.n_iterations > 0 ? rz / before : 0.);
    h.matrix.Multiply(false, p, q);
    double pq = 0.;
    p.Dot(q, &pq);
    x.Update(rz / pq, p, 1.);
    r.Update(-rz / pq, q, 1.);
    r.Norm2(&residual);
  }
  Eigen::VectorXd result(right_hand_side.size());
  for (Eigen::Index k = 0; k < result.size(); ++k)
    result(k) = x[h.rows.row_of_unknown[static_cast<std::size_t>(k)]];
  return result;
}

int MultigridSolver::n_iterations() const
{
  return hierarchy->n_iterations;
}
} // namespace fem
