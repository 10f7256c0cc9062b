#include "flat_mesh.h"

#include <fem/membrane.h>
#include <fem/surface_mesh.h>

#include <gtest/gtest.h>

#include <numbers>

namespace
{
Eigen::Vector3d normal(const fem::SurfaceMesh &mesh, std::size_t quad)
{
  const auto x = [&](std::size_t v)
  { return mesh.nodes[static_cast<std::size_t>(mesh.quads[quad][v])]; };
  return (x(2) - x(0)).cross(x(3) - x(1)).normalized();
}

Eigen::Vector3d centre(const fem::SurfaceMesh &mesh, std::size_t quad)
{
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const std::int32_t node : mesh.quads[quad])
    sum += mesh.nodes[static_cast<std::size_t>(node)] / 4.;
  return sum;
}

TEST(SurfaceMesh, BoxSidesFaceOutwards)
{
  const Eigen::Vector3d lower(-1., 2., 3.), upper(2., 4., 3.5);
  const fem::SurfaceMesh mesh = fem::box_sides(lower, upper, {3, 2, 4});
  EXPECT_EQ(mesh.nodes.size(), 10u * 5u);
  ASSERT_EQ(mesh.quads.size(), 10u * 4u);
  const Eigen::Vector3d middle = 0.5 * (lower + upper);
  for (std::size_t k = 0; k < mesh.quads.size(); ++k)
  {
    const Eigen::Vector3d n = normal(mesh, k);
    EXPECT_DOUBLE_EQ(n.cwiseAbs().maxCoeff(), 1.);
    EXPECT_GT(n.dot(centre(mesh, k) - middle), 0.);
  }
  EXPECT_EQ(fem::nodes_at_height(mesh, 3., 1e-9).size(), 10u);
  EXPECT_EQ(fem::nodes_at_height(mesh, 3.5, 1e-9).size(), 10u);
}

TEST(SurfaceMesh, CylinderSideFacesOutwards)
{
  const fem::SurfaceMesh mesh = fem::cylinder_side(0.5, 2., 12, 3);
  for (std::size_t k = 0; k < mesh.quads.size(); ++k)
  {
    Eigen::Vector3d radial = centre(mesh, k);
    radial.z() = 0.;
    EXPECT_NEAR(normal(mesh, k).dot(radial.normalized()), 1., 1e-14);
  }
  for (const Eigen::Vector3d &node : mesh.nodes)
    EXPECT_NEAR(node.head<2>().norm(), 0.5, 1e-15);
}

TEST(SurfaceMesh, RefusesNonsense)
{
  const Eigen::Vector3d low(0., 0., 0.), high(1., 1., 1.);
  EXPECT_THROW(fem::box_sides(high, low, {1, 1, 1}), std::invalid_argument);
  EXPECT_THROW(fem::box_sides(low, high, {1, 0, 1}), std::invalid_argument);
  EXPECT_THROW(fem::cylinder_side(-1., 1., 8, 1), std::invalid_argument);
  EXPECT_THROW(fem::cylinder_side(1., 1., 2, 1), std::invalid_argument);
}

void expect_refused(const fem::SurfaceMesh &mesh, const std::string &part)
{
  try
  {
    fem::Membrane(fem::MembraneParameters(), mesh);
    FAIL() << "accepted a mesh with: " << part;
  }
  catch (const std::invalid_argument &error)
  {
    EXPECT_NE(std::string(error.what()).find(part), std::string::npos)
        << error.what();
  }
}

TEST(SurfaceMesh, MembraneRefusesBrokenMeshes)
{
  const fem::SurfaceMesh good = support::flat_square(1., 2);
  EXPECT_NO_THROW(fem::Membrane(fem::MembraneParameters(), good));

  fem::SurfaceMesh bad = good;
  bad.quads.clear();
  expect_refused(bad, "no quads");
  bad = good;
  bad.quads[1][2] = 9;
  expect_refused(bad, "node number 9, there are 9 nodes");
  bad = good;
  bad.nodes.emplace_back(5., 5., 5.);
  expect_refused(bad, "node 9 belongs to no quad");
  bad = good;
  std::swap(bad.quads[0][1], bad.quads[0][3]);
  expect_refused(bad, "turned differently");
  bad = good;
  std::swap(bad.quads[0][1], bad.quads[0][2]);
  expect_refused(bad, "re-entrant");
  bad = good;
  bad.nodes[4] = bad.nodes[0];
  expect_refused(bad, "degenerate");
  bad = good;
  bad.nodes[4].z() = std::numeric_limits<double>::quiet_NaN();
  expect_refused(bad, "not a number");
}

TEST(EnclosedVolume, OfBoxAndCylinder)
{
  const fem::Membrane box(
      fem::MembraneParameters(),
      fem::box_sides({1., 2., 3.}, {2., 4., 6.}, {2, 3, 4}));
  EXPECT_NEAR(box.enclosed_volume(), 6., 1e-13);
  const int n = 16;
  const fem::Membrane cylinder(fem::MembraneParameters(),
                               fem::cylinder_side(0.5, 2., n, 3));
  const double polygon = 0.5 * n * 0.25 * std::sin(2. * std::numbers::pi / n);
  EXPECT_NEAR(cylinder.enclosed_volume(), 2. * polygon, 1e-14);
}

TEST(EnclosedVolume, FollowsAnAffineMap)
{
  fem::Membrane box(fem::MembraneParameters(),
                    fem::box_sides({0., 0., 0.}, {1., 1., 1.}, {2, 3, 4}));
  Eigen::Matrix3d map;
  map << 1.2, 0.3, 0.1, -0.2, 0.9, 0.4, 0., 0.2, 1.1;
  std::vector<Eigen::Vector3d> moved;
  for (const Eigen::Vector3d &node : box.mesh().nodes)
    moved.push_back(map * node + Eigen::Vector3d(100., 200., 300.));
  box.set_positions(moved);
  // Positions near 400 carry 6e-14 of round-off.
  EXPECT_NEAR(box.enclosed_volume(), map.determinant(), 1e-12);
}
} // namespace
