#include "multigrid.h"

#include "node_owners.h"

#include <Epetra_CrsMatrix.h>
#include <Epetra_Map.h>
#include <Epetra_MpiComm.h>
#include <Epetra_Vector.h>
#include <mpi.h>

#include <algorithm>
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

MPI_Comm communicator_of(MultigridSolver::Spread spread)
{
  return spread == MultigridSolver::Spread::all_ranks ? MPI_COMM_WORLD
                                                      : MPI_COMM_SELF;
}

/// Three rows for every node that has an unknown, as aggregation by nodes wants
/// it: a fixed component is a row of its own. The rows of a rank follow each
/// other.
struct NodeRows
{
  NodeRows(const SolidParts &parts, const Epetra_Comm &communicator);

  std::vector<int> row_of_unknown;
  std::vector<int> n_rows;       ///< of each rank
  std::vector<std::size_t> node; ///< of each triple of rows of this rank
  int first = 0;                 ///< row of this rank
  int size() const { return 3 * static_cast<int>(node.size()); }
  bool is_own(int row) const { return row >= first && row < first + size(); }
};

bool has_unknown(const SolidSupports &supports, std::size_t node)
{
  return supports.unknown(node, 0) >= 0 || supports.unknown(node, 1) >= 0 ||
         supports.unknown(node, 2) >= 0;
}

NodeRows::NodeRows(const SolidParts &parts, const Epetra_Comm &communicator)
    : row_of_unknown(parts.supports.n_unknowns())
{
  const std::vector<int> owner =
      divide_nodes(parts.mesh, communicator.NumProc());
  int next = 0;
  for (int rank = 0; rank < communicator.NumProc(); ++rank)
  {
    const bool is_this = rank == communicator.MyPID();
    const int before = next;
    for (std::size_t k = 0; k < owner.size(); ++k)
    {
      if (owner[k] != rank || !has_unknown(parts.supports, k))
        continue;
      for (int c = 0; c < 3; ++c)
        if (const std::int32_t unknown = parts.supports.unknown(k, c);
            unknown >= 0)
          row_of_unknown[static_cast<std::size_t>(unknown)] = next + c;
      next += 3;
      if (is_this)
        node.push_back(k);
    }
    n_rows.push_back(next - before);
    if (is_this)
      first = before;
  }
}

/// Translations of the nodes of this rank and rotations about the middle of
/// the whole body, one after the other.
std::vector<double> rigid_motions(const NodeRows &rows,
                                  std::span<const Eigen::Vector3d> nodes)
{
  const auto n = static_cast<std::size_t>(rows.size());
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d &node : nodes)
    middle += node / static_cast<double>(nodes.size());
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
  Hierarchy(const SolidParts &parts, const SystemWeights &weights,
            Spread spread)
      : communicator(communicator_of(spread)), rows(parts, communicator),
        motions(rigid_motions(rows, parts.mesh.nodes)),
        map(-1, rows.size(), 0, communicator), matrix(Copy, map, 81)
  {
    fill(parts, weights);
    coarsen();
  }

  /// In blocks of rows, whose summands take much more memory than their sums.
  void fill(const SolidParts &parts, const SystemWeights &weights)
  {
    constexpr std::size_t most_nodes = 4000;
    std::vector<char> is_marked(rows.row_of_unknown.size(), 0);
    for (std::size_t begin = 0; begin < rows.node.size(); begin += most_nodes)
    {
      const std::span<const std::size_t> block = std::span(rows.node).subspan(
          begin, std::min(most_nodes, rows.node.size() - begin));
      mark(parts.supports, block, 1, is_marked);
      const SparseRows sum = assemble_rows(parts, weights, is_marked);
      for (const std::size_t node : block)
        insert_node(parts.supports, node, sum);
      mark(parts.supports, block, 0, is_marked);
    }
    matrix.FillComplete();
    matrix.OptimizeStorage();
  }

  static void mark(const SolidSupports &supports,
                   std::span<const std::size_t> nodes, char value,
                   std::span<char> is_marked)
  {
    for (const std::size_t node : nodes)
      for (int c = 0; c < 3; ++c)
        if (const std::int32_t unknown = supports.unknown(node, c);
            unknown >= 0)
          is_marked[static_cast<std::size_t>(unknown)] = value;
  }

  /// Fixed components get the largest diagonal entry of their node.
  void insert_node(const SolidSupports &supports, std::size_t node,
                   const SparseRows &sum)
  {
    double largest = 0.;
    int first_row = 0;
    for (int c = 0; c < 3; ++c)
      if (const std::int32_t unknown = supports.unknown(node, c); unknown >= 0)
      {
        insert_row(unknown, sum);
        largest = std::max(largest, sum.coeff(unknown, unknown));
        first_row = rows.row_of_unknown[static_cast<std::size_t>(unknown)] - c;
      }
    for (int c = 0; c < 3; ++c)
      if (const int row = first_row + c; supports.unknown(node, c) < 0)
        matrix.InsertGlobalValues(row, 1, &largest, &row);
  }

  void insert_row(std::int32_t unknown, const SparseRows &sum)
  {
    columns.clear();
    for (SparseRows::InnerIterator entry(sum, unknown); entry; ++entry)
      columns.push_back(
          rows.row_of_unknown[static_cast<std::size_t>(entry.col())]);
    matrix.InsertGlobalValues(
        rows.row_of_unknown[static_cast<std::size_t>(unknown)],
        static_cast<int>(columns.size()),
        sum.valuePtr() + sum.outerIndexPtr()[unknown], columns.data());
  }

  /// No entry is dropped: where inertia rules, all would be. Aggregates end at
  /// the borders of the ranks on all levels: where they do not, ML wants all
  /// three columns of a node of another rank, and a fixed component has none.
  void coarsen()
  {
    Teuchos::ParameterList list;
    ML_Epetra::SetDefaults("SA", list);
    list.set("ML output", 0);
    list.set("PDE equations", 3);
    list.set("aggregation: type", "Uncoupled");
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

  void take_own(const Eigen::VectorXd &values, Epetra_Vector &own) const
  {
    for (std::size_t k = 0; k < rows.row_of_unknown.size(); ++k)
      if (const int row = rows.row_of_unknown[k]; rows.is_own(row))
        own[row - rows.first] = values(static_cast<Eigen::Index>(k));
  }

  Eigen::VectorXd gathered(const Epetra_Vector &own) const
  {
    std::vector<int> firsts(rows.n_rows.size(), 0);
    for (std::size_t k = 1; k < firsts.size(); ++k)
      firsts[k] = firsts[k - 1] + rows.n_rows[k - 1];
    std::vector<double> all(static_cast<std::size_t>(map.NumGlobalElements()));
    MPI_Allgatherv(own.Values(), rows.size(), MPI_DOUBLE, all.data(),
                   rows.n_rows.data(), firsts.data(), MPI_DOUBLE,
                   communicator.Comm());
    Eigen::VectorXd values(
        static_cast<Eigen::Index>(rows.row_of_unknown.size()));
    for (std::size_t k = 0; k < rows.row_of_unknown.size(); ++k)
      values(static_cast<Eigen::Index>(k)) =
          all[static_cast<std::size_t>(rows.row_of_unknown[k])];
    return values;
  }

  const Epetra_MpiComm communicator;
  const NodeRows rows;
  std::vector<double> motions;
  const Epetra_Map map;
  Epetra_CrsMatrix matrix;
  std::vector<int> columns; ///< of the row that is inserted
  std::optional<ML_Epetra::MultiLevelPreconditioner> preconditioner;
  int n_iterations = 0;
};

MultigridSolver::MultigridSolver(const SolidParts &parts,
                                 const SystemWeights &weights, Spread spread)
{
  start_mpi_once();
  hierarchy = std::make_unique<Hierarchy>(parts, weights, spread);
}
MultigridSolver::~MultigridSolver() = default;

Eigen::VectorXd MultigridSolver::solve(const Eigen::VectorXd &right_hand_side,
                                       double tolerance)
{
  Hierarchy &h = *hierarchy;
  Epetra_Vector x(h.map), r(h.map), z(h.map), p(h.map), q(h.map);
  h.take_own(right_hand_side, r);
  const double limit = tolerance * right_hand_side.norm();
  double residual = right_hand_side.norm(), rz = 0.;
  for (h.n_iterations = 0; !(residual <= limit); ++h.n_iterations)
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
  return h.gathered(x);
}

int MultigridSolver::n_iterations() const
{
  return hierarchy->n_iterations;
}
} // namespace fem
