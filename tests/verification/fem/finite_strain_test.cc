#include "flat_mesh.h"
#include "solid_scene.h"

#include <gtest/gtest.h>

namespace
{
using Vector = Eigen::Vector3d;
using Matrix = Eigen::Matrix3d;

fem::SolidLayer rubber(double poisson)
{
  fem::SolidLayer layer;
  layer.youngs_modulus = 1e6;
  layer.poisson_ratio = poisson;
  layer.density = 1000.;
  layer.law = fem::SolidLaw::neo_hooke;
  return layer;
}

fem::Solid body(const fem::SolidLayer &layer, const fem::SolidMesh &mesh)
{
  fem::SolidParameters p;
  p.layers = {layer};
  return fem::Solid(p, mesh);
}

/// 3 x 3 x 3 cells whose inner nodes are shaken.
fem::SolidMesh shaken_cube()
{
  fem::SolidMesh mesh = support::box({1., 1., 1.}, {3, 3, 3});
  const auto moved = support::shaken(mesh.nodes, 0.06, 4);
  for (std::size_t k = 0; k < mesh.nodes.size(); ++k)
    if ((mesh.nodes[k].array() > 0.01).all() &&
        (mesh.nodes[k].array() < 0.99).all())
      mesh.nodes[k] = moved[k];
  return mesh;
}

/// The whole surface goes to F x; the largest error of the other nodes.
double drive(fem::Solid &solid, const Matrix &deformation)
{
  const auto &nodes = solid.mesh().nodes;
  for (std::size_t k = 0; k < nodes.size(); ++k)
    solid.set_support_displacement(static_cast<std::int32_t>(k),
                                   deformation * nodes[k] - nodes[k]);
  solid.settle(support::no_loads(solid));
  double error = 0.;
  for (std::size_t k = 0; k < nodes.size(); ++k)
    error = std::max(
        error, (solid.displacements()[k] - (deformation * nodes[k] - nodes[k]))
                   .norm());
  return error;
}

fem::Solid held_cube(double poisson)
{
  fem::Solid solid = body(rubber(poisson), shaken_cube());
  for (std::int32_t side = 0; side < 6; ++side)
    solid.fix(side, {true, true, true});
  return solid;
}

TEST(FiniteStrain, KeepsAUniformDeformationOnAnyCells)
{
  fem::Solid solid = held_cube(0.3);
  Matrix change;
  change << 0.3, 0.2, -0.1, 0.05, -0.2, 0.3, -0.2, 0.1, 0.1;
  for (const double share : {0.5, 1.})
    EXPECT_LT(drive(solid, Matrix::Identity() + share * change), 1e-9);
  const auto first = solid.stress(0);
  for (std::size_t k = 1; k < solid.mesh().cells.size(); ++k)
    for (std::size_t i = 0; i < 6; ++i)
      EXPECT_NEAR(solid.stress(k)[i], first[i], 1e-8 * 1e6);
}

// A turn makes no stress, and turns what is there.
TEST(FiniteStrain, TurningStoresNothing)
{
  fem::Solid solid = held_cube(0.3);
  const auto turned = [](double angle) -> Matrix
  {
    return Eigen::AngleAxisd(angle, Vector(1., 2., -0.5).normalized())
        .toRotationMatrix();
  };
  for (double angle = 0.3; angle < 3.; angle += 0.3)
    EXPECT_LT(drive(solid, turned(angle)), 1e-8);
  EXPECT_NEAR(solid.energy().strain, 0., 1e-9 * 1e6);

  fem::Solid stretched = held_cube(0.3);
  const Matrix stretch = Vector(1.3, 0.9, 1.).asDiagonal();
  drive(stretched, stretch);
  const double energy = stretched.energy().strain;
  for (double angle = 0.3; angle < 1.6; angle += 0.3)
  {
    drive(stretched, turned(angle) * stretch);
    EXPECT_NEAR(stretched.energy().strain, energy, 1e-9 * energy);
  }
}

/// Nominal stress of a bar at this stretch: the lateral one by bisection from
/// the Cauchy stresses mu J^(-5/3) (lambda_i^2 - tr / 3) + K / 2 (J - 1 / J).
double bar_stress(const fem::SolidLayer &layer, double stretch)
{
  const double mu = layer.youngs_modulus / (2. * (1. + layer.poisson_ratio));
  const double bulk =
      layer.youngs_modulus / (3. * (1. - 2. * layer.poisson_ratio));
  const auto stress = [&](double lateral, double along)
  {
    const double ratio = stretch * lateral * lateral;
    const double trace = stretch * stretch + 2. * lateral * lateral;
    return mu * std::pow(ratio, -5. / 3.) * (along * along - trace / 3.) +
           0.5 * bulk * (ratio - 1. / ratio);
  };
  double low = 0.3, high = 3.;
  for (int k = 0; k < 80; ++k)
  {
    const double middle = 0.5 * (low + high);
    (stress(middle, middle) < 0. ? low : high) = middle;
  }
  return stress(low, stretch) * low * low;
}

TEST(FiniteStrain, BarInTensionAndCompression)
{
  for (const double poisson : {0.3, 0.49})
    for (const double end : {0.6, 2.})
    {
      const fem::SolidMesh mesh = support::box({1., 1., 1.}, {2, 2, 2});
      const fem::SolidLayer layer = rubber(poisson);
      fem::Solid solid = body(layer, mesh);
      solid.fix(fem::x_lower, {true, false, false});
      solid.fix(fem::y_lower, {false, true, false});
      solid.fix(fem::z_lower, {false, false, true});
      solid.fix(fem::x_upper, {true, false, false});
      const auto top = fem::boundary_nodes(mesh, fem::x_upper);
      for (int k = 1; k <= 10; ++k)
      {
        const double stretch = 1. + 0.1 * k * (end - 1.);
        for (const std::int32_t node : top)
          solid.set_support_displacement(node, Vector(stretch - 1., 0., 0.));
        solid.settle(support::no_loads(solid));
        double force = 0.;
        for (const std::int32_t node : top)
          force -= solid.reaction(node).x();
        const double exact = bar_stress(layer, stretch);
        EXPECT_NEAR(force, exact, 1e-7 * std::abs(exact));
      }
    }
}

struct Tip
{
  double down = 0., inward = 0.; ///< over the length [-]
};

/// Elastica under a dead load at its end, alpha = P L^2 / (E I): theta'' =
/// -alpha cos theta, theta(0) = 0, theta'(1) = 0; by shooting.
Tip elastica(double alpha)
{
  const auto shoot = [&](double curvature, Tip &tip)
  {
    constexpr int n = 4000;
    const double h = 1. / n;
    double theta = 0., slope = curvature, x = 0., y = 0.;
    for (int k = 0; k < n; ++k)
    {
      const double half = slope - 0.5 * h * alpha * std::cos(theta);
      const double middle = theta + 0.5 * h * half;
      x += h * std::cos(middle);
      y += h * std::sin(middle);
      theta += h * half;
      slope = half - 0.5 * h * alpha * std::cos(theta);
    }
    tip = {y, 1. - x};
    return slope;
  };
  double low = 0., high = alpha;
  Tip tip;
  for (int k = 0; k < 60; ++k)
  {
    const double middle = 0.5 * (low + high);
    (shoot(middle, tip) < 0. ? low : high) = middle;
  }
  return tip;
}

/// Cantilever 1 x 0.05 x 0.05 m, n cells through the height.
Tip bent(int n, double alpha)
{
  const double height = 0.05;
  const fem::SolidMesh mesh =
      support::box({1., height, height}, {20 * n, 1, n});
  const fem::SolidLayer layer = rubber(0.);
  fem::Solid solid = body(layer, mesh);
  solid.fix(fem::x_lower, {true, true, true});
  const double force = alpha * layer.youngs_modulus * std::pow(height, 4) / 12.;
  constexpr int n_steps = 8;
  for (int k = 1; k <= n_steps; ++k)
    solid.settle(fem::traction_loads(
        mesh, fem::x_upper,
        [&](const Vector &)
        { return Vector(0., 0., -force * k / n_steps / (height * height)); }));
  Tip tip;
  for (const double z : {0., height})
  {
    const auto node =
        static_cast<std::size_t>(support::node_at(mesh, Vector(1., 0., z)));
    tip.down -= 0.5 * solid.displacements()[node].z();
    tip.inward -= 0.5 * solid.displacements()[node].x();
  }
  return tip;
}

// Trilinear cells are too stiff in bending by (G / E) / n^2, n through the
// height: order two, and two meshes meet the elastica.
TEST(FiniteStrain, CantileverMeetsTheElastica)
{
  const double alpha = 2.;
  const Tip exact = elastica(alpha);
  const Tip coarse = bent(3, alpha), fine = bent(6, alpha);
  const double down = (4. * fine.down - coarse.down) / 3.;
  const double inward = (4. * fine.inward - coarse.inward) / 3.;
  std::printf("elastica %.5f %.5f, 3 cells %.5f %.5f, 6 cells %.5f %.5f, limit "
              "%.5f %.5f\n",
              exact.down, exact.inward, coarse.down, coarse.inward, fine.down,
              fine.inward, down, inward);
  EXPECT_NEAR(fine.down, exact.down, 0.02 * exact.down);
  EXPECT_NEAR(down, exact.down, 0.004 * exact.down);
  EXPECT_NEAR(inward, exact.inward, 0.008 * exact.inward);
}

/// Imbalance of a bar that is pulled and swings, over the work [-].
double explicit_imbalance(double share)
{
  const fem::SolidMesh mesh = support::box({1., 0.25, 0.25}, {8, 2, 2});
  fem::Solid solid = body(rubber(0.3), mesh);
  solid.fix(fem::x_lower, {true, true, true});
  solid.fix(fem::x_upper, {true, false, false});
  const double limit = solid.stable_time_step().time_step;
  for (const std::int32_t node : fem::boundary_nodes(mesh, fem::x_upper))
    solid.set_support_velocity(node, Vector(10., 0., 0.));
  const int n = static_cast<int>(std::ceil(0.04 / (share * limit)));
  for (int k = 0; k < n; ++k)
  {
    solid.begin_step(0.04 / n);
    solid.end_step(support::no_loads(solid), 0.04 / n);
  }
  const fem::SolidEnergy e = solid.energy();
  return std::abs(support::balance(e)) / e.support_work;
}

TEST(FiniteStrain, ExplicitMotionKeepsTheBalanceInSecondOrder)
{
  const double coarse = explicit_imbalance(0.4);
  const double fine = explicit_imbalance(0.1);
  std::printf("balance %.2e, %.2e of the work\n", coarse, fine);
  EXPECT_LT(coarse, 1e-2);
  EXPECT_LT(fine, 0.15 * coarse);
}

TEST(FiniteStrain, NewtonIsQuadraticAndRefusesTooMuchAtOnce)
{
  const fem::SolidMesh mesh = support::box({1., 1., 1.}, {2, 2, 2});
  fem::Solid solid = body(rubber(0.3), mesh);
  solid.fix(fem::x_lower, {true, true, true});
  const auto pull = [&](double traction)
  {
    return fem::traction_loads(mesh, fem::x_upper,
                               [&](const Vector &)
                               { return Vector(traction, 0., 0.); });
  };
  solid.settle(pull(2e5));
  const auto left = solid.newton_residuals();
  ASSERT_GE(left.size(), 4u);
  std::size_t last = 0;
  while (last + 1 < left.size() && left[last + 1] > 1e-12)
    ++last;
  ASSERT_GE(last, 2u);
  EXPECT_GT(std::log(left[last] / left[last - 1]) /
                std::log(left[last - 1] / left[last - 2]),
            1.6);
  const Vector before = solid.displacements()[0];
  EXPECT_THROW(solid.settle(pull(-1e8)), std::runtime_error);
  EXPECT_EQ(solid.displacements()[0], before);
}
} // namespace
