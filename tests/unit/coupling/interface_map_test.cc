#include "flat_mesh.h"

#include <coupling/membrane_body.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>

namespace
{
using Vector = Eigen::Vector3d;

fem::SurfaceMesh small_box()
{
  return fem::box_sides({0., 0., 0.}, {0.1, 0.08, 0.12}, {3, 2, 4});
}

/// Each quad starts at another corner, all nodes have other numbers.
fem::SurfaceMesh renumbered(const fem::SurfaceMesh &mesh, unsigned int seed)
{
  std::mt19937 generator(seed);
  std::vector<std::int32_t> number(mesh.nodes.size());
  std::iota(number.begin(), number.end(), 0);
  std::shuffle(number.begin(), number.end(), generator);
  fem::SurfaceMesh out = mesh;
  for (std::size_t k = 0; k < number.size(); ++k)
    out.nodes[static_cast<std::size_t>(number[k])] = mesh.nodes[k];
  for (auto &quad : out.quads)
  {
    for (std::int32_t &node : quad)
      node = number[static_cast<std::size_t>(node)];
    std::rotate(quad.begin(), quad.begin() + generator() % 4, quad.end());
  }
  std::shuffle(out.quads.begin(), out.quads.end(), generator);
  return out;
}

coupling::NodeMotion motion_of(const fem::Membrane &membrane)
{
  return {membrane.positions(), membrane.velocities()};
}

dem::FacetSurface make_surface(const coupling::InterfaceMap &map,
                               const fem::Membrane &membrane)
{
  return map.make_surface(motion_of(membrane),
                          coupling::movable_mass(membrane));
}

/// A membrane in the midst of some motion.
void shake(fem::Membrane &membrane, unsigned int seed)
{
  membrane.set_positions(support::shaken(membrane.mesh().nodes, 0.005, seed));
  const auto kick = support::random_vectors(membrane.n_nodes(), 1., seed + 1);
  for (int step = 0; step < 3; ++step)
  {
    membrane.begin_step(1e-5);
    membrane.end_step(kick, 1e-5);
  }
}

// T^t f on one side, T x and T v on the other: equal up to the round-off of
// some 70 terms, for any motion, load and numbering.
TEST(InterfaceMap, ForceMomentAndPowerBalance)
{
  for (unsigned int seed = 0; seed < 8; ++seed)
  {
    const fem::SurfaceMesh mesh =
        seed == 0 ? small_box() : renumbered(small_box(), seed);
    fem::Membrane membrane(fem::MembraneParameters(), mesh);
    const coupling::InterfaceMap map(membrane.mesh());
    dem::FacetSurface surface = make_surface(map, membrane);
    shake(membrane, 10 * seed);
    map.send_motion(motion_of(membrane), surface);
    surface.load =
        support::random_vectors(surface.position.size(), 1e4, seed + 50);
    // To be overwritten.
    std::vector<Vector> nodal_load(membrane.n_nodes(), Vector::Ones());
    map.collect(surface.load, nodal_load);
    const coupling::InterfaceBalance balance =
        coupling::check_balance(surface, motion_of(membrane), nodal_load);
    EXPECT_LT(balance.force_error, 1e-15);
    EXPECT_LT(balance.moment_error, 1e-15);
    EXPECT_LT(balance.power_error, 1e-15);
  }
}

// Springs on vertices become springs on nodes: the same motion of the contact
// from T x as from x, and no more than four nodes.
TEST(InterfaceMap, SpringsMoveFromVerticesToNodes)
{
  fem::Membrane membrane(fem::MembraneParameters(), renumbered(small_box(), 3));
  membrane.tie({0, 5});
  const coupling::InterfaceMap map(membrane.mesh());
  dem::FacetSurface surface = make_surface(map, membrane);
  auto positions = support::random_vectors(membrane.n_nodes(), 1., 4);
  positions[0] = positions[5] = Vector::Zero();
  membrane.set_positions(positions);
  map.send_motion(motion_of(membrane), surface);
  dem::SpringNetwork springs;
  springs.mass.assign(2 + surface.mass.size(), 1.);
  springs.inertia.assign(2, 1.);
  const std::array<double, 3> weight{0.2, 0.5, 0.3};
  for (const auto &triangle : surface.triangles)
  {
    springs.a.push_back(1);
    springs.b.emplace_back();
    for (std::size_t c = 0; c < 3; ++c)
      springs.b.back()[c] = {2 + triangle[c], weight[c]};
  }
  springs.a.push_back(0);
  springs.b.push_back({dem::FarShare{1, 1.}}); // two particles: left alone
  const coupling::SurfacePoints points{&map, coupling::movable_mass(membrane)};
  coupling::refer_to_nodes({&points, 1}, springs);
  ASSERT_EQ(springs.n_bodies(), 2 + membrane.n_nodes());
  EXPECT_EQ(springs.mass[2 + 7], membrane.nodal_mass()[7]);
  for (std::size_t k = 0; k < surface.triangles.size(); ++k)
  {
    Vector expected = Vector::Zero(), found = Vector::Zero();
    for (std::size_t c = 0; c < 3; ++c)
      expected +=
          weight[c] *
          surface.position[static_cast<std::size_t>(surface.triangles[k][c])];
    for (const dem::FarShare &share : springs.b[k])
      if (share.body >= 0)
      {
        EXPECT_FALSE(membrane.is_tied(share.body - 2));
        found += share.weight *
                 membrane.positions()[static_cast<std::size_t>(share.body - 2)];
      }
    // Tied nodes are walls; they stand at the origin here.
    EXPECT_LT((found - expected).norm(), 1e-15);
  }
  EXPECT_EQ(springs.b.back()[0].body, 1);
}

TEST(InterfaceMap, BalanceSeesAWrongLoad)
{
  fem::Membrane membrane(fem::MembraneParameters(), small_box());
  const coupling::InterfaceMap map(membrane.mesh());
  dem::FacetSurface surface = make_surface(map, membrane);
  shake(membrane, 4);
  map.send_motion(motion_of(membrane), surface);
  surface.load = support::random_vectors(surface.position.size(), 1., 7);
  std::vector<Vector> load(membrane.n_nodes());
  map.collect(surface.load, load);
  std::swap(load[11], load[12]); // the sum of forces stays
  const coupling::InterfaceBalance balance =
      coupling::check_balance(surface, motion_of(membrane), load);
  EXPECT_LT(balance.force_error, 1e-15);
  EXPECT_GT(balance.moment_error, 1e-4);
  EXPECT_GT(balance.power_error, 1e-4);
  load[3] *= 1.01;
  EXPECT_GT(
      coupling::check_balance(surface, motion_of(membrane), load).force_error,
      1e-5);
  load.pop_back();
  EXPECT_THROW(coupling::check_balance(surface, motion_of(membrane), load),
               std::invalid_argument);
}

TEST(InterfaceMap, NoLoadIsNoError)
{
  const fem::Membrane membrane(fem::MembraneParameters(), small_box());
  const coupling::InterfaceMap map(membrane.mesh());
  const dem::FacetSurface surface = make_surface(map, membrane);
  std::vector<Vector> load(membrane.n_nodes());
  map.collect(surface.load, load);
  EXPECT_EQ(
      coupling::check_balance(surface, motion_of(membrane), load).moment_error,
      0.);
  load[0].x() = 1.;
  EXPECT_TRUE(std::isinf(
      coupling::check_balance(surface, motion_of(membrane), load).force_error));
}

TEST(InterfaceMap, SurfaceCoversTheQuadsAndFacesOutwards)
{
  const fem::Membrane membrane(fem::MembraneParameters(), small_box());
  const dem::FacetSurface surface =
      make_surface(coupling::InterfaceMap(membrane.mesh()), membrane);
  const Vector middle(0.05, 0.04, 0.06);
  ASSERT_EQ(surface.triangles.size(), 4 * membrane.mesh().quads.size());
  double area = 0.;
  for (const auto &triangle : surface.triangles)
  {
    const auto x = [&](std::size_t v)
    { return surface.position[static_cast<std::size_t>(triangle[v])]; };
    const Vector twice = (x(1) - x(0)).cross(x(2) - x(0));
    EXPECT_GT(twice.dot(x(0) - middle), 0.);
    area += 0.5 * twice.norm();
  }
  EXPECT_NEAR(area, 2. * (0.1 + 0.08) * 0.12, 1e-15);
  EXPECT_EQ(surface.load.size(), surface.position.size());
  EXPECT_EQ(surface.velocity.size(), surface.position.size());
}

TEST(InterfaceMap, ParticlesOutsideTurnTheFacets)
{
  const fem::Membrane membrane(fem::MembraneParameters(), small_box());
  const auto inside =
      make_surface(coupling::InterfaceMap(membrane.mesh()), membrane);
  const auto outside = make_surface(
      coupling::InterfaceMap(membrane.mesh(), coupling::ParticleSide::outside),
      membrane);
  for (std::size_t k = 0; k < inside.triangles.size(); ++k)
  {
    EXPECT_EQ(inside.triangles[k][0], outside.triangles[k][1]);
    EXPECT_EQ(inside.triangles[k][1], outside.triangles[k][0]);
  }
}

// 1 / M = sum w^2 / m: four nodes of weight 1/4 and mass m weigh 4 m.
TEST(InterfaceMap, MassesForTheDashpot)
{
  fem::Membrane membrane(fem::MembraneParameters(),
                         support::flat_square(0.1, 4));
  membrane.tie(support::square_rim(4));
  const dem::FacetSurface surface =
      make_surface(coupling::InterfaceMap(membrane.mesh()), membrane);
  const double m = 1100. * 1e-3 * 0.025 * 0.025;
  ASSERT_EQ(surface.mass.size(), 25u + 16u);
  EXPECT_TRUE(std::isinf(surface.mass[0]));
  EXPECT_NEAR(surface.mass[12], m, 1e-12 * m);
  EXPECT_NEAR(surface.mass[25], 16. * m, 1e-12 * m) << "one free corner";
  EXPECT_NEAR(surface.mass[26], 8. * m, 1e-12 * m) << "two free corners";
  EXPECT_NEAR(surface.mass[30], 4. * m, 1e-12 * m) << "four free corners";
}
} // namespace
