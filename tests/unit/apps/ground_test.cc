#include "errors.h"
#include "gmsh_file.h"
#include "subgrade/ground.h"
#include "subgrade/ground_file.h"
#include "test_folder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

namespace
{
using namespace spall;
namespace fs = std::filesystem;

/// As gmsh writes it, the layers as physical volumes from the top down; cells
/// so turned that they are read as they were.
void write_gmsh(const fem::SolidMesh &mesh, const fs::path &path)
{
  const auto n_layers = 1 + *std::ranges::max_element(mesh.layer);
  std::vector<std::string> elements;
  for (std::size_t k = 0; k < mesh.cells.size(); ++k)
  {
    elements.push_back("5 2 " + std::to_string(n_layers - mesh.layer[k]) +
                       " 1");
    for (const std::size_t v : {2, 3, 7, 6, 0, 1, 5, 4})
      elements.back() += " " + std::to_string(mesh.cells[k][v] + 1);
  }
  support::write_gmsh(path, mesh.nodes, elements);
}

/// A block of two layers of three cells across and more down.
class GroundFile : public testing::Test
{
protected:
  void SetUp() override
  {
    base.file = (support::test_folder() / "case.prm").string();
    LayerParameters &particles = base.subgrade.layer;
    particles.length = particles.width = 0.3;
    base.subgrade.plate.diameter = 0.2;
    GroundParameters &ground = base.subgrade.ground;
    ground.length = ground.width = 1.;
    ground.cell_size = 0.1;
    ground.growth = 1.4;
    ground.layers = "0.3 40e6 0.3 1900, 0.5 20e6 0.3 1800";
    block = ground_mesh(base);
    file = base;
    file.subgrade.ground.mesh = "ground.msh";
  }

  fs::path path() const { return support::test_folder() / "ground.msh"; }

  /// Of the file that these words of a mesh make.
  std::string refusal(const fem::SolidMesh &mesh) const
  {
    write_gmsh(mesh, path());
    try
    {
      make_ground(file);
    }
    catch (const InputError &what)
    {
      return what.what();
    }
    return "";
  }

  Case base, file;
  fem::SolidMesh block;
};

TEST_F(GroundFile, OfABlockIsTheBlock)
{
  write_gmsh(block, path());
  const fem::SolidMesh same = ground_mesh(file);
  EXPECT_EQ(same.nodes, block.nodes);
  EXPECT_EQ(same.cells, block.cells);
  EXPECT_EQ(same.layer, block.layer);
  ASSERT_EQ(same.faces.size(), block.faces.size());
  for (std::size_t k = 0; k < block.faces.size(); ++k)
  {
    EXPECT_EQ(same.faces[k].corners, block.faces[k].corners);
    EXPECT_EQ(same.faces[k].boundary, block.faces[k].boundary);
    EXPECT_EQ(same.faces[k].cell, block.faces[k].cell);
  }
}

// Wider below, the bottom inclined: a body that is no box.
fem::SolidMesh slanted(const fem::SolidMesh &block)
{
  fem::SolidMesh mesh = block;
  for (Eigen::Vector3d &node : mesh.nodes)
  {
    node.head<2>() *= 1. - 0.25 * node.z();
    node.z() *= 1. + 0.1 * node.x() / 0.6; // 0.6 = 0.5 (1 + 0.25 0.8)
  }
  return mesh;
}

/// Of the top at the corners of the plate, under a load in the middle [m].
double settlement(const Case &c)
{
  fem::Solid ground = make_ground(c);
  const auto &nodes = ground.mesh().nodes;
  std::vector<Eigen::Vector3d> load(nodes.size(), Eigen::Vector3d::Zero());
  std::vector<std::size_t> corners;
  for (std::size_t k = 0; k < nodes.size(); ++k)
    if (nodes[k].norm() < 1e-9)
      load[k].z() = -1e3;
    else if ((nodes[k].cwiseAbs() - Eigen::Vector3d(0.1, 0.1, 0.)).norm() <
             1e-9)
      corners.push_back(k);
  ground.settle(load);
  double sum = 0.;
  for (const std::size_t k : corners)
    sum -= ground.displacements()[k].z();
  return sum / 4.;
}

TEST_F(GroundFile, NeedNotBeABox)
{
  file.subgrade.ground.layers = "0.3 40e6 0.3 1900, 0.58 20e6 0.3 1800";
  EXPECT_EQ(refusal(slanted(block)), "");
  const fem::SolidMesh mesh = ground_mesh(file);
  std::array<int, 7> n{};
  for (const fem::SolidMesh::Face &face : mesh.faces)
    ++n.at(static_cast<std::size_t>(face.boundary));
  EXPECT_EQ(n, (std::array{0, 0, 0, 0, 64, 64, 4 * 8 * 6}));
  // Cut out of one half-space, both give way alike: 0.5 % apart, with free
  // slanted sides 23 %.
  base.subgrade.ground.layers = "0.8 20e6 0.3 1800";
  file.subgrade.ground.layers = "0.88 20e6 0.3 1800";
  fem::SolidMesh one = slanted(block);
  std::ranges::fill(one.layer, 0);
  EXPECT_EQ(refusal(one), "");
  const double expected = settlement(base);
  EXPECT_NEAR(settlement(file), expected, 0.01 * expected);
  file.subgrade.ground.sides = GroundSide::rigid;
  EXPECT_NE(refusal(one).find("Subgrade/sides = rigid"), std::string::npos);
}

// One volume: by the depths of the centres; several: by their numbers.
TEST_F(GroundFile, LayersGoByDepthOrByVolume)
{
  fem::SolidMesh mesh = block;
  std::ranges::fill(mesh.layer, 0);
  EXPECT_EQ(refusal(mesh), "");
  EXPECT_EQ(ground_mesh(file).layer, block.layer);
  mesh.layer = block.layer;
  mesh.layer.front() = 1; // stiff in the lowest corner
  EXPECT_EQ(refusal(mesh), "");
  EXPECT_EQ(ground_mesh(file).layer, mesh.layer);
}

TEST_F(GroundFile, SaysWhatDoesNotFit)
{
  const auto expect = [this](const fem::SolidMesh &mesh, const char *words)
  {
    const std::string said = refusal(mesh);
    EXPECT_NE(said.find(words), std::string::npos) << said;
    EXPECT_NE(said.find("Subgrade/mesh = ground.msh"), std::string::npos);
  };
  const auto moved = [this](auto move)
  {
    fem::SolidMesh mesh = block;
    for (Eigen::Vector3d &node : mesh.nodes)
      move(node);
    return mesh;
  };
  expect(moved([](Eigen::Vector3d &x) { x *= 1000.; }), "files are in metres");
  expect(moved([](Eigen::Vector3d &x) { x.z() += 0.8; }), "must be at 0");
  expect(moved([](Eigen::Vector3d &x) { x.x() += 0.01; }),
         "no node at (0, 0, 0)");
  expect(moved([](Eigen::Vector3d &x) { x.head<2>() *= 0.25; }),
         "the box of the particles");
  expect(moved([](Eigen::Vector3d &x) { x.head<2>() *= 3.; }),
         "narrow side of the plate");
  // A pit in the top, a cell turned inside out.
  const auto pit = [](double depth)
  {
    return [depth](Eigen::Vector3d &x)
    {
      if (x.z() > -1e-9 && x.x() > 0.4 && x.y() > 0.4)
        x.z() -= depth;
    };
  };
  expect(moved(pit(0.01)), "looks up");
  expect(moved(pit(0.2)), "inside out");
  // The upper layer stands loose on the lower one.
  fem::SolidMesh loose = block;
  for (std::size_t k = 0; k < block.cells.size(); ++k)
    for (std::int32_t &node : loose.cells[k])
      if (block.layer[k] == 1)
      {
        loose.nodes.push_back(block.nodes[static_cast<std::size_t>(node)]);
        node = static_cast<std::int32_t>(loose.nodes.size()) - 1;
      }
  expect(loose, "must share their nodes");
  fem::SolidMesh volumes = block;
  volumes.layer.front() = 2;
  expect(volumes, "physical volumes");
  file.subgrade.ground.layers = "0.3 40e6 0.3 1900, 0.49 20e6 0.3 1800, "
                                "0.01 20e6 0.3 1800";
  fem::SolidMesh one = block;
  std::ranges::fill(one.layer, 0);
  expect(one, "layer 3");
}
} // namespace
