#include "flat_mesh.h"

#include <fem/membrane.h>

#include <gtest/gtest.h>

#include <numeric>

namespace
{
using Vector = Eigen::Vector3d;

std::vector<std::int32_t> all_quads(const fem::SurfaceMesh &mesh)
{
  std::vector<std::int32_t> all(mesh.quads.size());
  std::iota(all.begin(), all.end(), 0);
  return all;
}

double area_of(const fem::SurfaceMesh &mesh, std::size_t quad)
{
  const auto x = [&](std::size_t v)
  { return mesh.nodes[static_cast<std::size_t>(mesh.quads[quad][v])]; };
  return 0.5 * (x(2) - x(0)).cross(x(3) - x(1)).z();
}

// Quad 0, in the corner, and quad 4, in the middle of 3 x 3: they meet in a
// node. Two edges of the one lie on the rim, four of the other hang.
TEST(HalvedMesh, MidpointsHangOnWhatIsLeft)
{
  const fem::SurfaceMesh mesh = support::flat_square(0.3, 3);
  const std::vector<std::int32_t> quads{0, 4, 4};
  const fem::SurfaceMesh halved = fem::halve_quads(mesh, quads);
  ASSERT_EQ(halved.quads.size(), 7u + 2u * 4u);
  EXPECT_EQ(halved.nodes.size(), 16u + 2u * 5u);
  EXPECT_EQ(halved.midpoints.size(), 2u + 4u);
  double area = 0.;
  for (std::size_t k = 0; k < halved.quads.size(); ++k)
  {
    EXPECT_GT(area_of(halved, k), 0.); // turned as they were
    area += area_of(halved, k);
  }
  EXPECT_NEAR(area, 0.09, 1e-15);
  for (const fem::SurfaceMesh::Midpoint &middle : halved.midpoints)
  {
    const auto at = [&](std::int32_t node)
    { return halved.nodes[static_cast<std::size_t>(node)]; };
    EXPECT_EQ(at(middle.node), 0.5 * (at(middle.ends[0]) + at(middle.ends[1])));
    EXPECT_NEAR((at(middle.ends[0]) - at(middle.ends[1])).norm(), 0.1, 1e-15);
  }
}

TEST(HalvedMesh, AllQuadsAreAFinerMesh)
{
  const fem::SurfaceMesh coarse =
      fem::box_sides({0., 0., 0.}, {0.1, 0.2, 0.3}, {2, 3, 2});
  const fem::SurfaceMesh halved = fem::halve_quads(coarse, all_quads(coarse));
  const fem::SurfaceMesh fine =
      fem::box_sides({0., 0., 0.}, {0.1, 0.2, 0.3}, {4, 6, 4});
  EXPECT_TRUE(halved.midpoints.empty());
  ASSERT_EQ(halved.nodes.size(), fine.nodes.size());
  EXPECT_EQ(halved.quads.size(), fine.quads.size());
  for (const Vector &node : halved.nodes)
    EXPECT_TRUE(std::ranges::any_of(fine.nodes, [&](const Vector &other)
                                    { return (node - other).norm() < 1e-15; }));
  const fem::MembraneParameters p;
  EXPECT_NEAR(fem::Membrane(p, halved).stable_time_step(),
              fem::Membrane(p, fine).stable_time_step(), 1e-11);
}

TEST(HalvedMesh, KeepsTheVolumeOfATube)
{
  const fem::SurfaceMesh coarse = fem::cylinder_side(0.1, 0.2, 12, 3);
  const std::vector<std::int32_t> quads{0, 1, 5, 13, 30};
  const fem::MembraneParameters p;
  fem::Membrane whole(p, coarse), halved(p, fem::halve_quads(coarse, quads));
  EXPECT_NEAR(halved.enclosed_volume(), whole.enclosed_volume(), 1e-15);
  double mass = 0.;
  for (const double of_node : halved.nodal_mass())
    mass += of_node;
  EXPECT_NEAR(mass,
              std::reduce(whole.nodal_mass().begin(), whole.nodal_mass().end()),
              1e-12 * mass);
}

TEST(HalvedMesh, RefusesNonsense)
{
  const fem::SurfaceMesh mesh = support::flat_square(0.3, 3);
  const auto halve = [&](std::vector<std::int32_t> quads)
  { return fem::halve_quads(mesh, quads); };
  EXPECT_THROW(halve({9}), std::invalid_argument);
  EXPECT_THROW(halve({-1}), std::invalid_argument);
  const fem::SurfaceMesh once = halve({4});
  EXPECT_THROW(fem::halve_quads(once, std::vector<std::int32_t>{0}),
               std::invalid_argument);
  // The end of an edge with a midpoint is in the middle of another.
  fem::SurfaceMesh chained = once;
  chained.midpoints.front().ends[0] = chained.midpoints.back().node;
  EXPECT_THROW(fem::Membrane({}, chained), std::invalid_argument);
  chained.midpoints.front().ends[0] = 1000;
  EXPECT_THROW(fem::Membrane({}, chained), std::invalid_argument);
  fem::SurfaceMesh beside = once;
  beside.nodes[static_cast<std::size_t>(beside.midpoints.front().node)].z() +=
      1e-6;
  EXPECT_THROW(fem::Membrane({}, beside), std::invalid_argument);
  EXPECT_NO_THROW(fem::Membrane({}, once));
}
} // namespace
