#include "solid_scene.h"

#include <gtest/gtest.h>

namespace
{
using Vector = Eigen::Vector3d;

// Boussinesq: 160 kPa on a disc of radius 0.15 m.
const fem::SolidLayer subgrade{60e6, 0.3, 1900.};
constexpr double radius = 0.15, pressure = 160e3;
const double force = M_PI * radius * radius * pressure;
const double plane_modulus = subgrade.youngs_modulus / (1. - 0.3 * 0.3);

/// Block with the circle of the disc among its lines; h is the cell under it,
/// `reach` the distance to the far sides, in radii.
fem::SolidMesh block(int n, double reach)
{
  fem::QuarterCylinder block;
  block.radius = radius;
  block.n_square = n;
  // Finer towards the edge of the disc, where stress is steep or singular.
  const double size = 0.6 * radius / n;
  for (int k = 0; k < n; ++k)
    block.inner.push_back(std::pow(0.5, 3. * k / n));
  const double edge = 0.45 * radius * std::pow(0.5, 3. * (n - 1) / n) / n * 1.5;
  const double growth = 1. + 0.6 / n;
  block.outer = fem::graded_widths(edge, growth, (reach - 1.) * radius);
  block.heights = fem::graded_widths(0.5 * size, growth, reach * radius);
  return fem::quarter_cylinder_mesh(block);
}

std::vector<std::int32_t> disc_nodes(const fem::SolidMesh &mesh)
{
  std::vector<std::int32_t> nodes;
  for (const std::int32_t node : fem::boundary_nodes(mesh, fem::z_upper))
    if (mesh.nodes[static_cast<std::size_t>(node)].head<2>().norm() <
        radius * (1. + 1e-9))
      nodes.push_back(node);
  return nodes;
}

enum class FarSide
{
  at_rest,
  point_load ///< moved as a point load of the same force would move it
};

fem::Solid half_space(const fem::SolidMesh &mesh)
{
  fem::SolidParameters p;
  p.layers = {subgrade};
  fem::Solid solid(p, mesh);
  solid.fix(fem::x_lower, {true, false, false});
  solid.fix(fem::y_lower, {false, true, false});
  solid.fix(fem::x_upper, {true, true, true});
  solid.fix(fem::z_lower, {true, true, true});
  return solid;
}

void move_far_side(fem::Solid &solid, double total)
{
  const support::PointLoad field{total, subgrade};
  for (const std::int32_t side : {fem::x_upper, fem::z_lower})
    for (const std::int32_t node : fem::boundary_nodes(solid.mesh(), side))
      solid.set_support_displacement(
          node, field(solid.mesh().nodes[static_cast<std::size_t>(node)]));
}

struct Settlement
{
  double centre = 0., edge = 0., mean = 0.; ///< over the closed form [-]
};

/// 2 q a / E*, at the edge 2 / pi of it, in the mean 16 q a / (3 pi E*).
Settlement flexible_disc(int n, double reach, FarSide far)
{
  const fem::SolidMesh mesh = block(n, reach);
  fem::Solid solid = half_space(mesh);
  if (far == FarSide::point_load)
    move_far_side(solid, force);
  const auto loads = fem::traction_loads(
      mesh, fem::z_upper,
      [](const Vector &x)
      { return Vector(0., 0., x.head<2>().norm() < radius ? -pressure : 0.); },
      8);
  solid.settle(loads);
  double sum = 0., work = 0.;
  for (std::size_t k = 0; k < loads.size(); ++k)
  {
    sum += loads[k].z();
    work += loads[k].z() * solid.displacements()[k].z();
  }
  const double exact = 2. * pressure * radius / plane_modulus;
  const auto at = [&](const Vector &x)
  {
    return -solid
                .displacements()[static_cast<std::size_t>(
                    support::node_at(mesh, x))]
                .z();
  };
  return {at(Vector::Zero()) / exact,
          at(Vector(radius, 0., 0.)) / exact * (0.5 * M_PI),
          work / std::abs(sum) / exact * (3. * M_PI / 8.)};
}

/// Stiffness of a rigid, smooth disc over 2 a E*.
double rigid_disc(int n, double reach, FarSide far)
{
  const fem::SolidMesh mesh = block(n, reach);
  fem::Solid solid = half_space(mesh);
  const double depth = 1e-3;
  const auto disc = disc_nodes(mesh);
  for (const std::int32_t node : disc)
  {
    solid.fix_node(node, {false, false, true});
    solid.set_support_displacement(node, Vector(0., 0., -depth));
  }
  const auto total = [&](double far_force)
  {
    if (far == FarSide::point_load)
      move_far_side(solid, far_force);
    solid.settle(support::no_loads(solid));
    double sum = 0.;
    for (const std::int32_t node : disc)
      sum += solid.reaction(node).z();
    return 4. * sum; // of the whole disc
  };
  // Linear in the force the far side is moved by: it must be the own one.
  const double without = total(0.);
  const double unit = 2. * radius * plane_modulus * depth;
  const double with = far == FarSide::point_load ? total(unit) : without;
  const double own = without / (1. - (with - without) / unit);
  return own / unit;
}

// Far sides six radii away. At rest they hold back a tenth and more: what is
// cut off settles by about a / (reach a) of the whole. Moved as a point load
// would move them they leave (a / reach)^3; then the mean settlement, which is
// the work of the load, is left with the error of the cells, below 0.3 %.
TEST(HalfSpace, SettlementOfAFlexibleDisc)
{
  const Settlement held = flexible_disc(4, 6., FarSide::at_rest);
  const Settlement coarse = flexible_disc(3, 6., FarSide::point_load);
  const Settlement fine = flexible_disc(6, 6., FarSide::point_load);
  for (const Settlement &s : {held, coarse, fine})
    std::printf("centre %.5f edge %.5f mean %.5f\n", s.centre, s.edge, s.mean);
  EXPECT_NEAR(fine.mean, 1., 4e-3);
  EXPECT_NEAR(fine.centre, 1., 4e-3);
  EXPECT_NEAR(fine.edge, 1., 1e-2);
  EXPECT_LT(std::abs(fine.mean - 1.), std::abs(coarse.mean - 1.));
  EXPECT_NEAR(held.mean, 0.86, 0.03);
}

// Stress is singular at the edge of a rigid disc: first order in the cells
// there, so the limit of two meshes is compared.
TEST(HalfSpace, StiffnessOfARigidDisc)
{
  const double coarse = rigid_disc(3, 6., FarSide::point_load);
  const double fine = rigid_disc(6, 6., FarSide::point_load);
  std::printf("stiffness / 2 a E*: %.5f %.5f, limit %.5f\n", coarse, fine,
              2. * fine - coarse);
  EXPECT_NEAR(fine, 1., 8e-3);
  EXPECT_NEAR(2. * fine - coarse, 1., 4e-3);
}
} // namespace
