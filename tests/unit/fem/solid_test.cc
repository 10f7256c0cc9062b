#include "face_points.h"
#include "flat_mesh.h"
#include "solid_element.h"
#include "solid_operator.h"
#include "solid_scene.h"
#include "test_folder.h"

#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

namespace
{
using Vector = Eigen::Vector3d;

const fem::SolidLayer soil{50e6, 0.3, 1800.};

fem::CellCorners shaken_cell(unsigned int seed)
{
  std::vector<Vector> nodes;
  for (int v = 0; v < 8; ++v)
    nodes.emplace_back(0.1 * (v & 1), 0.12 * (v >> 1 & 1), 0.09 * (v >> 2 & 1));
  nodes = support::shaken(nodes, 0.015, seed);
  fem::CellCorners corners;
  std::copy(nodes.begin(), nodes.end(), corners.begin());
  return corners;
}

// Six rigid motions and nothing else are free of energy: no hourglasses.
TEST(SolidCell, HasSixFreeMotions)
{
  for (unsigned int seed = 1; seed < 20; ++seed)
  {
    const fem::CellMatrix k = fem::cell_stiffness(shaken_cell(seed), soil);
    const Eigen::SelfAdjointEigenSolver<fem::CellMatrix> solver(k);
    const auto &values = solver.eigenvalues();
    EXPECT_LT(std::abs(values(5)), 1e-12 * values(23));
    EXPECT_GT(values(0), -1e-12 * values(23));
    EXPECT_GT(values(6), 1e-3 * values(23));
  }
}

// The volume within the bilinear faces, by the divergence theorem.
TEST(SolidCell, WeighsItsVolume)
{
  const fem::CellCorners corners = shaken_cell(3);
  fem::SolidMesh mesh = support::box({1., 1., 1.}, {1, 1, 1});
  for (std::size_t v = 0; v < 8; ++v)
    mesh.nodes[static_cast<std::size_t>(mesh.cells[0][v])] = corners[v];
  double volume = 0., mass = 0.;
  for (const fem::SolidMesh::Face &face : mesh.faces)
    for (const fem::FacePoint &point : fem::face_points(mesh, face, 1))
      volume += point.position.dot(point.area) / 3.;
  for (const double share : fem::cell_mass(corners, soil.density))
    mass += share;
  EXPECT_NEAR(mass, soil.density * volume, 1e-12 * mass);
}

TEST(SolidCell, RefusesCellsTurnedInsideOut)
{
  fem::CellCorners corners = shaken_cell(1);
  std::swap(corners[0], corners[1]);
  EXPECT_THROW(fem::cell_stiffness(corners, soil), std::invalid_argument);
}

// All vector widths, shared matrices and single cells: the same product.
TEST(SolidOperator, MultipliesAsTheCellsDo)
{
  fem::SolidMesh mesh = support::box({1., 0.7, 0.5}, {5, 4, 3});
  for (std::size_t k = 0; k < mesh.nodes.size(); k += 7)
    mesh.nodes[k] += Vector(0.01, -0.01, 0.02); // some cells stay alone
  const fem::SolidOperator elastic(mesh, std::vector{soil});
  const auto u = support::random_vectors(mesh.nodes.size(), 1e-3, 5);
  std::vector<Vector> out(u.size()), expected(u.size(), Vector::Zero());
  elastic.multiply(u, out);
  double largest = 0.;
  for (std::size_t k = 0; k < mesh.cells.size(); ++k)
  {
    fem::CellCorners corners;
    Eigen::Matrix<double, 24, 1> local;
    for (std::size_t v = 0; v < 8; ++v)
    {
      const auto node = static_cast<std::size_t>(mesh.cells[k][v]);
      corners[v] = mesh.nodes[node];
      local.segment<3>(3 * static_cast<Eigen::Index>(v)) = u[node];
    }
    const Eigen::Matrix<double, 24, 1> force =
        fem::cell_stiffness(corners, soil) * local;
    for (std::size_t v = 0; v < 8; ++v)
      expected[static_cast<std::size_t>(mesh.cells[k][v])] +=
          force.segment<3>(3 * static_cast<Eigen::Index>(v));
  }
  for (const Vector &f : expected)
    largest = std::max(largest, f.norm());
  for (std::size_t k = 0; k < out.size(); ++k)
    EXPECT_LT((out[k] - expected[k]).norm(), 1e-12 * largest);
}

TEST(CellKernel, GivesTheSameBitsAtEveryWidth)
{
  double matrix[576], in[24][fem::cell_lanes];
  const auto numbers = support::random_vectors(400, 1., 9);
  for (int i = 0; i < 576; ++i)
    matrix[i] = numbers[static_cast<std::size_t>(i / 3)](i % 3);
  for (int i = 0; i < 24 * fem::cell_lanes; ++i)
    in[i / fem::cell_lanes][i % fem::cell_lanes] =
        numbers[static_cast<std::size_t>(200 + i / 3)](i % 3);
  double first[24][fem::cell_lanes], other[24][fem::cell_lanes];
  fem::cell_kernels().front()(matrix, in, first);
  for (const fem::CellKernel kernel : fem::cell_kernels())
  {
    kernel(matrix, in, other);
    for (int i = 0; i < 24; ++i)
      for (int lane = 0; lane < fem::cell_lanes; ++lane)
        EXPECT_EQ(first[i][lane], other[i][lane]);
  }
}

TEST(SolidMesh, GivesLayersByHeight)
{
  fem::SolidMesh mesh = support::box({1., 1., 3.}, {1, 1, 3});
  fem::assign_layers(mesh, std::vector{1., 2.});
  EXPECT_EQ(mesh.layer, (std::vector<std::int32_t>{0, 1, 1}));
}

// Two hexahedra of two physical volumes, the top of one marked as 7.
TEST(SolidMesh, ReadsGmshFiles)
{
  const std::string path = (support::test_folder() / "two_cells.msh").string();
  std::ofstream(path) << "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n"
                         "$Nodes\n12\n"
                         "1 0 0 0\n2 1 0 0\n3 1 1 0\n4 0 1 0\n"
                         "5 0 0 1\n6 1 0 1\n7 1 1 1\n8 0 1 1\n"
                         "9 0 0 3\n10 1 0 3\n11 1 1 3\n12 0 1 3\n"
                         "$EndNodes\n$Elements\n3\n"
                         "1 3 2 7 1 9 10 11 12\n"
                         "2 5 2 0 1 1 2 3 4 5 6 7 8\n"
                         "3 5 2 1 2 5 6 7 8 9 10 11 12\n"
                         "$EndElements\n";
  const fem::SolidMesh mesh = fem::read_solid_mesh(path);
  EXPECT_EQ(mesh.nodes.size(), 12u);
  EXPECT_EQ(mesh.layer, (std::vector<std::int32_t>{0, 1}));
  EXPECT_EQ(mesh.faces.size(), 10u);
  const fem::SolidSurface top = fem::boundary_surface(mesh, 7);
  EXPECT_EQ(top.mesh.quads.size(), 1u);
  for (const Vector &node : top.mesh.nodes)
    EXPECT_EQ(node.z(), 3.);
  double area = 0.;
  for (const Vector &load : fem::traction_loads(
           mesh, 7, [](const Vector &) { return Vector(0., 0., 1.); }))
    area += load.z();
  EXPECT_NEAR(area, 1., 1e-12);
  const fem::SolidOperator elastic(mesh, std::vector{soil, soil});
  double mass = 0.;
  for (const double m : elastic.mass())
    mass += m;
  EXPECT_NEAR(mass, 3. * soil.density, 1e-9);

  std::ofstream(path) << "no mesh\n";
  EXPECT_THROW(fem::read_solid_mesh(path), std::invalid_argument);
  EXPECT_THROW(fem::read_solid_mesh(path + "none"), std::invalid_argument);
}

// What touches the top sees it move, and its loads arrive at the body.
TEST(SolidSurface, SendsMotionAndLoads)
{
  fem::Solid solid({}, support::box({1., 1., 1.}, {2, 2, 2}));
  solid.fix(fem::z_lower, {true, true, true});
  const fem::SolidSurface top =
      fem::boundary_surface(solid.mesh(), fem::z_upper);
  EXPECT_EQ(top.node.size(), 9u);
  const auto loads = support::random_vectors(9, 100., 3);
  auto body_loads = support::no_loads(solid);
  fem::add_loads(top, loads, body_loads);
  solid.advance(body_loads, 1e-3);
  std::vector<Vector> positions(9), velocities(9);
  fem::send_motion(solid, top, positions, velocities);
  double work = 0.;
  for (std::size_t k = 0; k < 9; ++k)
  {
    const auto node = static_cast<std::size_t>(top.node[k]);
    EXPECT_EQ(velocities[k], solid.velocities()[node]);
    work += 0.5 * loads[k].dot(positions[k] - top.mesh.nodes[k]);
  }
  // Positions of 1 m lose what is below 1e-16 of motions of 1e-6 m.
  EXPECT_NEAR(work, solid.energy().load_work, 1e-8 * std::abs(work));
  for (const auto &quad : top.mesh.quads)
  {
    const auto at = [&](std::size_t v)
    { return top.mesh.nodes[static_cast<std::size_t>(quad[v])]; };
    EXPECT_GT((at(2) - at(0)).cross(at(3) - at(1)).z(), 0.);
  }
}

TEST(Solid, WritesItsFrames)
{
  fem::Solid solid({}, support::box({1., 1., 1.}, {2, 1, 1}));
  std::ostringstream text;
  solid.write_vtu(text);
  EXPECT_NE(text.str().find("displacement_m"), std::string::npos);
  EXPECT_NE(text.str().find("NumberOfCells=\"2\""), std::string::npos);
}

TEST(SolidMesh, RoundBlockFillsItsVolume)
{
  fem::QuarterCylinder block;
  block.n_square = 16;
  block.inner = {1., 1., 1.};
  block.outer = {0.5, 0.5};
  block.heights = {1., 2.};
  const fem::SolidMesh mesh = fem::quarter_cylinder_mesh(block);
  const fem::SolidOperator elastic(mesh, std::vector{soil});
  double mass = 0.;
  for (const double m : elastic.mass())
    mass += m;
  // The rim is a polygon of 32 chords over a right angle.
  const double chord = M_PI / 64.;
  EXPECT_NEAR(mass, soil.density * 3. * 32. * 0.5 * 4. * std::sin(chord),
              1e-9 * mass);
  double top = 0.;
  const auto loads = fem::traction_loads(
      mesh, fem::z_upper, [](const Vector &) { return Vector(0., 0., 1.); });
  for (const Vector &load : loads)
    top += load.z();
  EXPECT_NEAR(top, 32. * 0.5 * 4. * std::sin(chord), 1e-9);
}

TEST(Solid, RefusesWhatMakesNoSense)
{
  fem::SolidMesh mesh = support::box({1., 1., 1.}, {1, 1, 1});
  fem::SolidParameters p;
  p.layers[0].poisson_ratio = 0.5;
  EXPECT_THROW(fem::Solid(p, mesh), std::invalid_argument);
  p.layers[0].poisson_ratio = 0.3;
  fem::Solid solid(p, mesh);
  EXPECT_THROW(solid.fix(9, {true, true, true}), std::invalid_argument);
  EXPECT_THROW(solid.begin_step(0.), std::invalid_argument);
  EXPECT_THROW(solid.settle(support::no_loads(solid)), std::runtime_error);
  mesh.layer[0] = 1;
  EXPECT_THROW(fem::Solid(p, mesh), std::invalid_argument);
}

// Hanging nodes, supports, dashpots and damping; explicit, then implicit.
TEST(Solid, ResumesBitForBit)
{
  fem::BoxMesh box;
  box.widths.fill({0.5, 0.5});
  box.refined.push_back({Vector(0., 0., 0.5), Vector(0.5, 0.5, 1.), 1});
  fem::SolidParameters p;
  p.mass_damping = 2.;
  p.stiffness_damping = 1e-4;
  const auto make = [&]
  {
    fem::Solid solid(p, fem::box_mesh(box));
    solid.absorb(fem::z_lower);
    solid.fix(fem::x_lower, {true, false, false});
    return solid;
  };
  const auto push = [](fem::Solid &solid, int n_steps)
  {
    auto loads = support::no_loads(solid);
    for (int k = 0; k < n_steps; ++k)
    {
      loads.back() = Vector(10., 20., -30.);
      solid.begin_step(1e-4);
      solid.end_step(loads, 1e-4);
      solid.advance(loads, 1e-3);
    }
  };
  fem::Solid whole = make(), first = make(), second = make();
  push(whole, 20);
  push(first, 10);
  std::stringstream file;
  first.save(file);
  second.load(file);
  push(second, 10);
  for (std::size_t k = 0; k < whole.mesh().nodes.size(); ++k)
  {
    EXPECT_EQ(whole.displacements()[k], second.displacements()[k]);
    EXPECT_EQ(whole.velocities()[k], second.velocities()[k]);
  }
  EXPECT_EQ(whole.energy().absorbed, second.energy().absorbed);
  fem::Solid other(p, fem::box_mesh(box));
  std::stringstream again;
  first.save(again);
  EXPECT_THROW(other.load(again), std::runtime_error);
}
} // namespace
