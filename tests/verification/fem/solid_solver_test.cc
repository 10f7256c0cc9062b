#include "solid_scene.h"

#include <gtest/gtest.h>

#include <chrono>

namespace
{
using Vector = Eigen::Vector3d;

double processor_seconds()
{
  return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

/// Two layers, held below, on rollers at two sides, with dashpots at a third.
fem::Solid block(const fem::SolidMesh &mesh, fem::SolidSolver solver,
                 double tolerance = 1e-10)
{
  fem::SolidParameters p;
  p.layers = {{50e6, 0.3, 1800.}, {200e6, 0.25, 2000.}};
  p.stiffness_damping = 1e-4;
  p.solver = solver;
  p.solver_tolerance = tolerance;
  fem::Solid solid(p, mesh);
  solid.fix(fem::z_lower, {true, true, true});
  solid.fix(fem::x_lower, {true, false, false});
  solid.fix(fem::y_lower, {false, true, false});
  solid.absorb(fem::x_upper);
  return solid;
}

fem::SolidMesh layered(int n, bool is_refined)
{
  fem::BoxMesh box;
  for (auto &widths : box.widths)
    widths.assign(static_cast<std::size_t>(n), 1. / n);
  if (is_refined)
    box.refined.push_back({Vector(0., 0., 0.7), Vector(0.5, 0.5, 1.), 1});
  fem::SolidMesh mesh = fem::box_mesh(box);
  const std::array<double, 2> tops{0.5, 1.};
  fem::assign_layers(mesh, tops);
  return mesh;
}

support::Vectors push(const fem::SolidMesh &mesh)
{
  return fem::traction_loads(mesh, fem::z_upper,
                             [](const Vector &x)
                             {
                               const bool is_under =
                                   std::hypot(x.x(), x.y()) < 0.5;
                               return Vector(0., 0., is_under ? -1e5 : 0.);
                             });
}

/// Largest difference over the largest displacement.
double apart(const fem::Solid &a, const fem::Solid &b)
{
  double difference = 0., size = 0.;
  for (std::size_t k = 0; k < a.displacements().size(); ++k)
  {
    difference = std::max(difference,
                          (a.displacements()[k] - b.displacements()[k]).norm());
    size = std::max(size, a.displacements()[k].norm());
  }
  return difference / size;
}

// Hanging nodes, partly fixed nodes, dashpots, two moduli.
TEST(SolidSolver, MultigridMeetsTheFactorsAtRest)
{
  const fem::SolidMesh mesh = layered(8, true);
  fem::Solid direct = block(mesh, fem::SolidSolver::direct);
  fem::Solid amg = block(mesh, fem::SolidSolver::amg);
  direct.settle(push(mesh));
  amg.settle(push(mesh));
  EXPECT_EQ(direct.solver_iterations(), 0);
  EXPECT_GT(amg.solver_iterations(), 3);
  EXPECT_LT(apart(amg, direct), 1e-9);
  EXPECT_GT(apart(amg, direct), 0.);
  fem::Solid again = block(mesh, fem::SolidSolver::amg);
  again.settle(push(mesh));
  EXPECT_EQ(apart(again, amg), 0.); // bit for bit
}

// From the step of the explicit motion, where mass rules, to long ones.
TEST(SolidSolver, MultigridMeetsTheFactorsInMotionAtAnyStep)
{
  const fem::SolidMesh mesh = layered(6, true);
  for (const double step : {1e-6, 1e-5, 1e-4, 1e-3, 1e-2, 1.})
  {
    fem::Solid direct = block(mesh, fem::SolidSolver::direct);
    fem::Solid amg = block(mesh, fem::SolidSolver::amg);
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
  const fem::SolidMesh mesh = layered(10, false);
  fem::Solid direct = block(mesh, fem::SolidSolver::direct);
  fem::Solid amg = block(mesh, fem::SolidSolver::amg, 1e-3);
  direct.settle(push(mesh));
  amg.settle(push(mesh));
  EXPECT_LT(apart(amg, direct), 1e-2);
  EXPECT_GT(apart(amg, direct), 1e-7);
  EXPECT_THROW(block(mesh, fem::SolidSolver::amg, 0.), std::invalid_argument);
}

struct Cost
{
  double first = 0., next = 0.; ///< with and without the set-up [s]
  int iterations = 0;
};

/// Five equal steps, or loads at rest where the step is zero.
Cost cost(const fem::SolidMesh &mesh, fem::SolidSolver solver, double step)
{
  fem::Solid solid = block(mesh, solver, 1e-8);
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
    const fem::SolidMesh mesh = layered(n, false);
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
