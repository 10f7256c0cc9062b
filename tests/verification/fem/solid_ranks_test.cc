// The solver whose matrices are spread over the ranks against factors that
// every rank has alone. Collective: all ranks run the same tests.
#include "layered_block.h"

#include <gtest/gtest.h>
#include <mpi.h>

namespace
{
using support::apart;
using support::layered_block;
using support::layered_mesh;
using support::push;

/// Largest difference between the displacements of any two ranks [m].
double between_ranks(const fem::Solid &solid)
{
  Eigen::VectorXd lowest(3 * solid.displacements().size());
  for (std::size_t k = 0; k < solid.displacements().size(); ++k)
    lowest.segment<3>(static_cast<Eigen::Index>(3 * k)) =
        solid.displacements()[k];
  Eigen::VectorXd highest = lowest;
  const int n = static_cast<int>(lowest.size());
  MPI_Allreduce(MPI_IN_PLACE, lowest.data(), n, MPI_DOUBLE, MPI_MIN,
                MPI_COMM_WORLD);
  MPI_Allreduce(MPI_IN_PLACE, highest.data(), n, MPI_DOUBLE, MPI_MAX,
                MPI_COMM_WORLD);
  return (highest - lowest).maxCoeff();
}

// Hanging nodes with parents on other ranks, partly fixed nodes, dashpots.
TEST(SolidOnRanks, MeetsTheFactorsAtRest)
{
  const fem::SolidMesh mesh = layered_mesh(8, true);
  fem::Solid direct = layered_block(mesh, fem::SolidSolver::direct);
  fem::Solid spread = layered_block(mesh, fem::SolidSolver::distributed_amg);
  direct.settle(push(mesh));
  spread.settle(push(mesh));
  EXPECT_GT(spread.solver_iterations(), 3);
  EXPECT_LT(spread.solver_iterations(), 40);
  EXPECT_LT(apart(spread, direct), 1e-9);
  EXPECT_GT(apart(spread, direct), 0.);
  EXPECT_EQ(between_ranks(spread), 0.);
}

TEST(SolidOnRanks, MeetsTheFactorsInMotionAtAnyStep)
{
  const fem::SolidMesh mesh = layered_mesh(6, true);
  for (const double step : {1e-6, 1e-4, 1e-2, 1.})
  {
    fem::Solid direct = layered_block(mesh, fem::SolidSolver::direct);
    fem::Solid spread = layered_block(mesh, fem::SolidSolver::distributed_amg);
    for (int k = 0; k < 5; ++k)
    {
      direct.advance(push(mesh), step);
      spread.advance(push(mesh), step);
    }
    EXPECT_LT(apart(spread, direct), 1e-8) << "step " << step;
    EXPECT_LT(spread.solver_iterations(), 40);
    EXPECT_EQ(between_ranks(spread), 0.);
  }
}

// A change of the supports makes rows and hierarchy again.
TEST(SolidOnRanks, FollowsNewSupports)
{
  const fem::SolidMesh mesh = layered_mesh(6, false);
  fem::Solid direct = layered_block(mesh, fem::SolidSolver::direct);
  fem::Solid spread = layered_block(mesh, fem::SolidSolver::distributed_amg);
  for (fem::Solid *solid : {&direct, &spread})
  {
    solid->settle(push(mesh));
    solid->fix(fem::y_upper, {false, true, false});
    solid->settle(push(mesh));
  }
  EXPECT_LT(apart(spread, direct), 1e-9);
}

// Every rank gets the message: none waits for another. A thousand iterations on
// more ranks than cores take a minute.
TEST(SolidOnRanks, LooseBodyIsRefusedOnAllRanks)
{
  int n_ranks = 0;
  MPI_Comm_size(MPI_COMM_WORLD, &n_ranks);
  if (n_ranks > 2)
    GTEST_SKIP();
  const fem::SolidMesh mesh = layered_mesh(4, false);
  fem::SolidParameters p;
  p.layers = {{50e6, 0.3, 1800.}, {200e6, 0.25, 2000.}};
  p.solver = fem::SolidSolver::distributed_amg;
  fem::Solid loose(p, mesh);
  EXPECT_THROW(loose.settle(push(mesh)), std::runtime_error);
}
} // namespace
