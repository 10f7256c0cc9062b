#include "flat_mesh.h"
#include "solid_scene.h"

#include <fem/condensed.h>

#include <gtest/gtest.h>

#include <chrono>

namespace
{
using Vector = Eigen::Vector3d;
using support::Vectors;

/// A layered block, n cells along each side, on a held bottom.
fem::Solid block(int n, bool has_damping)
{
  fem::SolidParameters p;
  p.layers = {{50e6, 0.3, 1800.}, {90e6, 0.25, 2000.}};
  if (has_damping)
  {
    p.mass_damping = 3.;
    p.stiffness_damping = 1e-4;
  }
  fem::SolidMesh mesh = support::box({1., 1., 0.6}, {n, n, n});
  fem::assign_layers(mesh, std::vector{0.3, 1.});
  fem::Solid solid(p, mesh);
  solid.fix(fem::z_lower, {true, true, true});
  if (has_damping)
    solid.absorb(fem::x_lower);
  return solid;
}

/// Nodes of the top within a square of this half side round its middle.
std::vector<std::int32_t> footprint(const fem::SolidMesh &mesh, double half)
{
  std::vector<std::int32_t> nodes;
  for (const std::int32_t node : fem::boundary_nodes(mesh, fem::z_upper))
  {
    const Vector x = mesh.nodes[static_cast<std::size_t>(node)];
    if (std::abs(x.x() - 0.5) < half && std::abs(x.y() - 0.5) < half)
      nodes.push_back(node);
  }
  return nodes;
}

Vectors on_body(const fem::Solid &solid, const std::vector<std::int32_t> &nodes,
                const Vectors &loads)
{
  Vectors all = support::no_loads(solid);
  for (std::size_t k = 0; k < nodes.size(); ++k)
    all[static_cast<std::size_t>(nodes[k])] = loads[k];
  return all;
}

double difference(const fem::Solid &solid, const fem::CondensedSolid &condensed,
                  const std::vector<std::int32_t> &nodes)
{
  double error = 0., size = 0.;
  for (std::size_t k = 0; k < nodes.size(); ++k)
  {
    const Vector u = solid.displacements()[static_cast<std::size_t>(nodes[k])];
    error = std::max(error, (condensed.displacements()[k] - u).norm());
    size = std::max(size, u.norm());
  }
  return error / size;
}

TEST(CondensedSolid, EquilibriumIsExactWithoutInnerModes)
{
  fem::Solid solid = block(8, true);
  const auto nodes = footprint(solid.mesh(), 0.3);
  fem::CondensedSolid condensed(solid, {nodes, 0, 0.});
  for (unsigned int seed = 1; seed < 4; ++seed)
  {
    const auto loads = support::random_vectors(nodes.size(), 100., seed);
    solid.settle(on_body(solid, nodes, loads));
    condensed.settle(loads);
    EXPECT_LT(difference(solid, condensed, nodes), 1e-11);
    EXPECT_NEAR(condensed.energy().strain, solid.energy().strain,
                1e-10 * solid.energy().strain);
    EXPECT_NEAR(support::balance(condensed.energy()), 0.,
                1e-10 * solid.energy().strain);
  }
}

/// Largest difference during a push of half a wave of 10 ms on the footprint.
double worst_difference(fem::Solid solid, int n_inner_modes, double time_step)
{
  const auto nodes = footprint(solid.mesh(), 0.3);
  fem::CondensedSolid condensed(solid, {nodes, n_inner_modes, time_step});
  double worst = 0., size = 0.;
  for (int k = 0; k * time_step < 0.03; ++k)
  {
    const double phase = std::min(1., (k + 1) * time_step / 0.01);
    const double push = 200. * std::sin(M_PI * phase);
    const Vectors loads(nodes.size(), Vector(0.3 * push, 0., -push));
    solid.advance(on_body(solid, nodes, loads), time_step);
    condensed.advance(loads);
    for (std::size_t n = 0; n < nodes.size(); ++n)
    {
      const Vector u =
          solid.displacements()[static_cast<std::size_t>(nodes[n])];
      worst = std::max(worst, (condensed.displacements()[n] - u).norm());
      size = std::max(size, u.norm());
    }
  }
  const double scale = solid.energy().load_work;
  EXPECT_LT(std::abs(support::balance(condensed.energy())), 1e-9 * scale);
  return worst / size;
}

// Dashpots, Rayleigh damping, layers: with every mode it is the body itself.
TEST(CondensedSolid, MotionIsExactWithAllModes)
{
  fem::Solid solid = block(4, true);
  const auto n = 3 * static_cast<int>(solid.mesh().nodes.size());
  EXPECT_LT(worst_difference(std::move(solid), n, 2e-4), 1e-9);
}

TEST(CondensedSolid, MotionConvergesWithTheModes)
{
  double last = 1.;
  for (const int n_modes : {0, 10, 40, 160})
  {
    const double error = worst_difference(block(8, true), n_modes, 2e-4);
    std::printf("%d inner modes: %.2e\n", n_modes, error);
    EXPECT_LT(error, 0.7 * last);
    last = error;
  }
  EXPECT_LT(last, 0.05);
}

// A clamped column: inner frequencies of the body with its top held, and equal
// ones of a square section found as often as they occur.
TEST(CondensedSolid, FindsEqualFrequencies)
{
  fem::SolidParameters p;
  p.layers = {{50e6, 0., 1800.}};
  fem::Solid solid(p, support::box({0.2, 0.2, 1.}, {2, 2, 10}));
  solid.fix(fem::z_lower, {true, true, true});
  const auto nodes = fem::boundary_nodes(solid.mesh(), fem::z_upper);
  const fem::CondensedSolid condensed(solid, {nodes, 8, 0.});
  const auto omega = condensed.inner_frequencies();
  EXPECT_NEAR(omega[0], omega[1], 1e-9 * omega[0]); // bending, two ways
  EXPECT_GT(omega[2], 1.05 * omega[1]);
  // Along the axis of a bar held at both ends: pi c / L, low by (pi h)^2 / 24
  // L^2 = 4e-3 with ten lumped cells.
  const double axial = M_PI * std::sqrt(50e6 / 1800.);
  double nearest = 1e9;
  for (const double w : omega)
    nearest = std::min(nearest, std::abs(w / axial - 1.));
  EXPECT_LT(nearest, 6e-3);
}

TEST(CondensedSolid, RefusesWhatMakesNoSense)
{
  fem::Solid solid = block(2, false);
  EXPECT_THROW(fem::CondensedSolid(solid, {{}, 0, 0.}), std::invalid_argument);
  EXPECT_THROW(fem::CondensedSolid(solid, {{999}, 0, 0.}),
               std::invalid_argument);
  fem::CondensedSolid condensed(solid, {{26}, 0, 0.});
  EXPECT_THROW(condensed.settle(Vectors(2)), std::invalid_argument);
  EXPECT_THROW(condensed.advance(Vectors(1)), std::logic_error);
}

double seconds_per_step(int n_steps, const std::function<void()> &step)
{
  const auto start = std::chrono::steady_clock::now();
  for (int k = 0; k < n_steps; ++k)
    step();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start)
             .count() /
         n_steps;
}

// Printed, not asserted but for the order: what a step costs.
TEST(LongCondensedSolid, CostPerStep)
{
  fem::Solid solid = block(20, true);
  const auto nodes = footprint(solid.mesh(), 0.16);
  const Vectors loads(nodes.size(), Vector(0., 0., -10.));
  const Vectors all = on_body(solid, nodes, loads);
  const double dt = 0.9 * solid.stable_time_step().time_step;
  const double step = seconds_per_step(200,
                                       [&]
                                       {
                                         solid.begin_step(dt);
                                         solid.end_step(all, dt);
                                       });
  solid.advance(all, dt); // factors
  const double implicit = seconds_per_step(10, [&] { solid.advance(all, dt); });
  std::printf("%zu cells, %zu interface nodes; explicit %.3f ms, implicit "
              "%.1f ms\n",
              solid.mesh().cells.size(), nodes.size(), 1e3 * step,
              1e3 * implicit);
  fem::CondensedSolid rest(solid, {nodes, 0, 0.});
  const double at_rest = seconds_per_step(2000, [&] { rest.settle(loads); });
  std::printf("condensed, at rest: %.4f ms, explicit / this %.0f\n",
              1e3 * at_rest, step / at_rest);
  for (const int n_modes : {0, 50, 200})
  {
    fem::CondensedSolid condensed(solid, {nodes, n_modes, dt});
    const double moving =
        seconds_per_step(500, [&] { condensed.advance(loads); });
    std::printf("condensed, %d inner modes: %.4f ms, explicit / this %.1f, "
                "implicit / this %.0f\n",
                n_modes, 1e3 * moving, step / moving, implicit / moving);
    EXPECT_LT(moving, implicit);
  }
  EXPECT_LT(at_rest, step);
}
} // namespace
