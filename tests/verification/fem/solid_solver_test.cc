#include "layered_block.h"

#include <gtest/gtest.h>

#include <chrono>

namespace
{
using support::apart;
using support::layered_block;
using support::layered_mesh;
using support::push;
using Vector = Eigen::Vector3d;

double processor_seconds()
{
  return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

// Hanging nodes, partly fixed nodes, dashpots, two moduli.
TEST(SolidSolver, MultigridMeetsTheFactorsAtRest)
{
  const fem::SolidMesh mesh = layered_mesh(8, true);
  fem::Solid direct = layered_block(mesh, fem::SolidSolver::direct);
  fem::Solid amg = layered_block(mesh, fem::SolidSolver::amg);
  direct.settle(push(mesh));
  amg.settle(push(mesh));
  EXPECT_EQ(direct.solver_iterations(), 0);
  EXPECT_GT(amg.solver_iterations(), 3);
  EXPECT_LT(apart(amg, direct), 1e-9);
  EXPECT_GT(apart(amg, direct), 0.);
  fem::Solid again = layered_block(mesh, fem::SolidSolver::amg);
  again.settle(push(mesh));
  EXPECT_EQ(apart(again, amg), 0.); // bit for bit
}

// From the step of the explicit motion, where mass rules, to long ones.
TEST(SolidSolver, MultigridMeetsTheFactorsInMotionAtAnyStep)
{
  const fem::SolidMesh mesh = layered_mesh(6, true);
  for (const double step : {1e-6, 1e-5, 1e-4, 1e-3, 1e-2, 1.})
  {
    fem::Solid direct = layered_block(mesh, fem::SolidSolver::direct);
    fem::Solid amg = layered_block(mesh, fem::SolidSolver::amg);
    int most = 0;
    for (int k = 0; k < 5; ++k)
    {
      direct.advance(push(mesh), step);
      amg.advance(push(mesh), step);
      most = std::max(most, amg.solver_iterations());
    }
    std::printf("step %.0e s: %d iterations, apart %.1e\n", step, most,
                apart(amg, direct));
    EXPECT_LT(apart(amg, direct), 1e-8);
    EXPECT_LT(most, 40);
  }
}

TEST(SolidSolver, LooseToleranceIsLessExact)
{
  const fem::SolidMesh mesh = layered_mesh(10, false);
  fem::Solid direct = layered_block(mesh, fem::SolidSolver::direct);
  fem::Solid amg = layered_block(mesh, fem::SolidSolver::amg, 1e-3);
  direct.settle(push(mesh));
  amg.settle(push(mesh));
  EXPECT_LT(apart(amg, direct), 1e-2);
  EXPECT_GT(apart(amg, direct), 1e-7);
  EXPECT_THROW(layered_block(mesh, fem::SolidSolver::amg, 0.),
               std::invalid_argument);
}

struct Cost
{
  double first = 0., next = 0.; ///< with and without the set-up [s]
  int iterations = 0;
};

/// Five equal steps, or loads at rest where the step is zero.
Cost cost(const fem::SolidMesh &mesh, fem::SolidSolver solver, double step)
{
  fem::Solid solid = layered_block(mesh, solver, 1e-8);
  support::Vectors load = push(mesh);
  Cost result;
  constexpr int n = 5;
  for (int k = 0; k <= n; ++k)
  {
    for (Vector &force : load)
      force *= 1.1;
    const double start = processor_seconds();
    if (step > 0.)
      solid.advance(load, step);
    else
      solid.settle(load);
    (k == 0 ? result.first : result.next) +=
        (processor_seconds() - start) / (k == 0 ? 1 : n);
  }
  result.iterations = solid.solver_iterations();
  return result;
}

// The table of docs/verification/continuum.md. Iterations hardly grow with the
// mesh; times are for reading.
TEST(LongSolidSolver, CostAgainstTheFactors)
{
  std::printf("unknowns  step s  direct: first s, next ms  amg: first s, next "
              "ms, iterations\n");
  std::vector<int> at_rest;
  for (const int n : {8, 14, 20, 32})
  {
    const fem::SolidMesh mesh = layered_mesh(n, false);
    for (const double step : {0., 1e-2, 1e-3, 1e-4})
    {
      const Cost amg = cost(mesh, fem::SolidSolver::amg, step);
      const Cost direct = n <= 20 || step == 0.
                              ? cost(mesh, fem::SolidSolver::direct, step)
                              : Cost{};
      std::printf("%8zu  %.0e  %7.2f %8.1f  %7.2f %8.1f %4d\n",
                  3 * mesh.nodes.size(), step, direct.first, 1e3 * direct.next,
                  amg.first, 1e3 * amg.next, amg.iterations);
      std::fflush(stdout);
      if (step == 0.)
        at_rest.push_back(amg.iterations);
    }
  }
  EXPECT_LT(at_rest.back(), 1.6 * at_rest.front());
}
} // namespace
