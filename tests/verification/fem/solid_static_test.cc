#include "flat_mesh.h"
#include "solid_scene.h"

#include <gtest/gtest.h>

namespace
{
using Vector = Eigen::Vector3d;

const fem::SolidLayer soil{50e6, 0.3, 1800.};

fem::SolidParameters of(const fem::SolidLayer &layer)
{
  fem::SolidParameters p;
  p.layers = {layer};
  return p;
}

/// Moves the nodes inside the box, but no hanging ones and none of the rim.
void shake(fem::SolidMesh &mesh, double size)
{
  std::vector<bool> stays(mesh.nodes.size(), false);
  for (const auto &face : mesh.faces)
    for (const std::int32_t node : face.corners)
      stays[static_cast<std::size_t>(node)] = true;
  for (const auto &hanging : mesh.hanging)
  {
    stays[static_cast<std::size_t>(hanging.node)] = true;
    for (const auto &[parent, weight] : hanging.parents)
      stays[static_cast<std::size_t>(parent)] = true;
  }
  const auto moved = support::shaken(mesh.nodes, size, 4);
  for (std::size_t k = 0; k < stays.size(); ++k)
    if (!stays[k])
      mesh.nodes[k] = moved[k];
}

fem::SolidMesh refined_box(int n)
{
  fem::BoxMesh box;
  for (auto &widths : box.widths)
    widths.assign(static_cast<std::size_t>(n), 1. / n);
  box.refined.push_back({Vector::Zero(), Vector(0.5, 0.5, 0.5), 1});
  return fem::box_mesh(box);
}

/// Holds the whole surface in a given field and returns the largest error of
/// the other nodes over the largest displacement.
template <typename Field>
double held_error(const fem::SolidMesh &mesh, const Field &exact)
{
  fem::Solid solid(of(soil), mesh);
  for (std::int32_t side = 0; side < 6; ++side)
    solid.fix(side, {true, true, true});
  for (std::size_t k = 0; k < mesh.nodes.size(); ++k)
    solid.set_support_displacement(static_cast<std::int32_t>(k),
                                   exact(mesh.nodes[k]));
  solid.settle(support::no_loads(solid));
  double error = 0., size = 0.;
  for (std::size_t k = 0; k < mesh.nodes.size(); ++k)
  {
    const Vector u = exact(mesh.nodes[k]);
    error = std::max(error, (solid.displacements()[k] - u).norm());
    size = std::max(size, u.norm());
  }
  return error / size;
}

TEST(SolidPatch, KeepsAUniformStrainOnAnyCells)
{
  Eigen::Matrix3d gradient;
  gradient << 1., 0.3, -0.2, 0.1, -0.5, 0.4, 0.7, -0.3, 0.2;
  fem::SolidMesh mesh = refined_box(4);
  EXPECT_GT(mesh.hanging.size(), 20u);
  shake(mesh, 0.04);
  const auto exact = [&](const Vector &x) -> Vector
  { return 1e-3 * gradient * x; };
  EXPECT_LT(held_error(mesh, exact), 1e-12);
}

// Hooke's law on shaken cells: u = eps x with the lateral strain free.
TEST(SolidPatch, StressAndEnergyOfABarInTension)
{
  fem::SolidMesh mesh = refined_box(4);
  shake(mesh, 0.04);
  fem::Solid solid(of(soil), mesh);
  solid.fix(fem::x_lower, {true, false, false});
  solid.fix(fem::y_lower, {false, true, false});
  solid.fix(fem::z_lower, {false, false, true});
  const double pull = 3e4;
  const auto loads = fem::traction_loads(
      mesh, fem::x_upper, [&](const Vector &) { return Vector(pull, 0., 0.); });
  solid.settle(loads);
  const double strain = pull / soil.youngs_modulus;
  const auto far =
      static_cast<std::size_t>(support::node_at(mesh, Vector(1., 1., 1.)));
  const Vector u = solid.displacements()[far];
  EXPECT_NEAR(u.x(), strain, 1e-12);
  EXPECT_NEAR(u.y(), -soil.poisson_ratio * strain, 1e-12);
  EXPECT_NEAR(u.z(), -soil.poisson_ratio * strain, 1e-12);
  for (std::size_t k = 0; k < mesh.cells.size(); ++k)
  {
    const auto stress = solid.stress(k);
    EXPECT_NEAR(stress[0], pull, 1e-8 * pull);
    for (std::size_t i = 1; i < 6; ++i)
      EXPECT_NEAR(stress[i], 0., 1e-8 * pull);
  }
  const double exact = 0.5 * pull * strain;
  EXPECT_NEAR(solid.energy().strain, exact, 1e-9 * exact);
  EXPECT_NEAR(solid.energy().load_work, exact, 1e-9 * exact);
  double reaction = 0.;
  for (const std::int32_t node : fem::boundary_nodes(mesh, fem::x_lower))
    reaction += solid.reaction(node).x();
  EXPECT_NEAR(reaction, pull, 1e-8 * pull);
}

// A point load on a half-space, seen in a box below it: no body forces, all
// displacements of the surface given. Order two with hanging nodes.
TEST(SolidConvergence, SecondOrderInAFieldOfAPointLoad)
{
  const support::PointLoad field{1e5, soil};
  const auto exact = [&](const Vector &x)
  { return field(x - Vector(0.2, 0.3, 1.4)); };
  const double coarse = held_error(refined_box(4), exact);
  const double middle = held_error(refined_box(8), exact);
  const double fine = held_error(refined_box(16), exact);
  std::printf("errors %.3e %.3e %.3e, order %.2f %.2f\n", coarse, middle, fine,
              std::log2(coarse / middle), std::log2(middle / fine));
  EXPECT_GT(std::log2(middle / fine), 1.8);
  EXPECT_LT(fine, 3e-3);
}

// Pure bending is exact in one cell through the height, with any Poisson's
// ratio: nothing locks. w = M x^2 / (2 E I) along the axis.
TEST(SolidBending, OneCellThroughTheHeightIsExact)
{
  for (const double poisson : {0., 0.3, 0.4999})
  {
    fem::SolidLayer layer = soil;
    layer.poisson_ratio = poisson;
    const fem::SolidMesh mesh = support::box({1., 0.1, 0.1}, {4, 1, 1});
    fem::Solid solid(of(layer), mesh);
    solid.fix(fem::x_lower, {true, false, false});
    const std::int32_t pin = support::node_at(mesh, Vector::Zero());
    solid.fix_node(pin, {true, true, true});
    solid.fix_node(support::node_at(mesh, Vector(0., 0.1, 0.)),
                   {false, false, true});
    const double edge_stress = 1e4;
    solid.settle(fem::traction_loads(
        mesh, fem::x_upper,
        [&](const Vector &x)
        { return Vector(edge_stress * (x.z() / 0.05 - 1.), 0., 0.); }));
    const auto tip =
        static_cast<std::size_t>(support::node_at(mesh, Vector(1., 0., 0.)));
    const double exact = -edge_stress / (0.05 * layer.youngs_modulus) * 0.5;
    EXPECT_NEAR(solid.displacements()[tip].z(), exact, 1e-8 * std::abs(exact));
  }
}

/// Mean deflection of the end of a cantilever 1 x 0.1 x 0.1 m under a
/// parabolic shear traction of resultant 1 N, n cells through the height.
double cantilever_tip(int n, double poisson)
{
  fem::SolidLayer layer = soil;
  layer.poisson_ratio = poisson;
  const fem::SolidMesh mesh = support::box({1., 0.1, 0.1}, {10 * n, n, n});
  fem::Solid solid(of(layer), mesh);
  solid.fix(fem::x_lower, {true, true, true});
  const auto shear = [](const Vector &x)
  { return Vector(0., 0., 6. * x.z() * (0.1 - x.z()) / 1e-4); };
  const auto loads = fem::traction_loads(mesh, fem::x_upper, shear, 2);
  solid.settle(loads);
  return 2. * solid.energy().load_work; // the force is 1 N
}

double beam_theory(double poisson)
{
  const double inertia = 1e-4 / 12.;
  const double shear_modulus = soil.youngs_modulus / (2. * (1. + poisson));
  const double kappa = 10. * (1. + poisson) / (12. + 11. * poisson);
  return 1. / (3. * soil.youngs_modulus * inertia) +
         1. / (kappa * 0.01 * shear_modulus);
}

// P L^3 / (3 E I) + P L / (kappa A G), kappa = 10 (1 + nu) / (12 + 11 nu)
// (Cowper). At nu = 0 the clamp holds nothing back but the warping of the
// section. With Poisson's ratio it stiffens the root, which is not in beam
// theory; at nu = 0.499 the singular rim of the clamp converges slowly.
TEST(SolidBending, CantileverMeetsBeamTheory)
{
  for (const double poisson : {0., 0.3, 0.499})
  {
    const double exact = beam_theory(poisson);
    const double coarse = cantilever_tip(1, poisson) / exact;
    const double middle = cantilever_tip(2, poisson) / exact;
    const double fine = cantilever_tip(4, poisson) / exact;
    std::printf("nu %.3f: tip / beam %.5f %.5f %.5f\n", poisson, coarse, middle,
                fine);
    EXPECT_NEAR(coarse, 1., poisson < 0.4 ? 0.02 : 0.17);
    EXPECT_NEAR(fine, 1., poisson == 0. ? 1e-3 : poisson < 0.4 ? 0.01 : 0.04);
  }
}
} // namespace
