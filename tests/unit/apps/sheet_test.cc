#include "errors.h"
#include "gmsh_file.h"
#include "specimen/specimen.h"
#include "test_folder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>

namespace
{
using namespace spall;
namespace fs = std::filesystem;
using Vector = Eigen::Vector3d;

const Vector low(0.1, 0.2, 0.3), high(0.16, 0.26, 0.4);

/// As gmsh writes it, every other quad the other way round.
void write_gmsh(const fem::SurfaceMesh &mesh, const fs::path &path)
{
  std::vector<std::string> elements;
  for (std::size_t k = 0; k < mesh.quads.size(); ++k)
  {
    auto quad = mesh.quads[k];
    if (k % 2 == 1)
      std::ranges::reverse(quad);
    elements.emplace_back("3 2 1 1");
    for (const std::int32_t node : quad)
      elements.back() += " " + std::to_string(node + 1);
  }
  support::write_gmsh(path, mesh.nodes, elements);
}

class SheetFile : public testing::Test
{
protected:
  void SetUp() override
  {
    base.file = (support::test_folder() / "case.prm").string();
    base.specimen.form = SpecimenForm::cylinder;
    base.boundary.elements_around = 20;
  }

  fs::path path() const { return support::test_folder() / "sheet.msh"; }
  fem::SurfaceMesh read(const fem::SurfaceMesh &mesh)
  {
    write_gmsh(mesh, path());
    Case c = base;
    c.boundary.mesh = "sheet.msh";
    return lateral_mesh(c, low, high);
  }
  std::string refusal(const fem::SurfaceMesh &mesh)
  {
    try
    {
      read(mesh);
    }
    catch (const InputError &what)
    {
      return what.what();
    }
    return "";
  }

  Case base;
};

double volume(const fem::SurfaceMesh &mesh)
{
  return fem::Membrane({}, mesh).enclosed_volume();
}

/// Largest distance of a node to the nearest one of the other mesh [m].
double distance(const fem::SurfaceMesh &mesh, const fem::SurfaceMesh &other)
{
  double largest = 0.;
  for (const Vector &node : mesh.nodes)
  {
    double nearest = (other.nodes[0] - node).norm();
    for (const Vector &position : other.nodes)
      nearest = std::min(nearest, (position - node).norm());
    largest = std::max(largest, nearest);
  }
  return largest;
}

// Whatever its unit and position, it is stretched to the specimen.
TEST_F(SheetFile, OfEqualQuadsIsTheMeshOfTheCase)
{
  const fem::SurfaceMesh own = lateral_mesh(base, low, high);
  const fem::SurfaceMesh file = read(fem::cylinder_side(40., 200., 20, 11));
  EXPECT_EQ(file.quads.size(), own.quads.size());
  EXPECT_LT(distance(own, file), 1e-15);
  EXPECT_NEAR(volume(file), volume(own), 1e-12 * volume(own));
  base.specimen.form = SpecimenForm::box;
  const int n = base.boundary.elements_per_side;
  const fem::SurfaceMesh box = lateral_mesh(base, low, high);
  const fem::SurfaceMesh same =
      read(fem::box_sides({0., 1., 2.}, {3., 9., 4.}, {n, n, n}));
  EXPECT_EQ(same.quads.size(), box.quads.size());
  EXPECT_LT(distance(box, same), 1e-15);
  EXPECT_NEAR(volume(same), (high - low).prod(), 1e-12 * volume(same));
}

// Quads of all widths: none of them cuts into the cylinder, the widest touches.
TEST_F(SheetFile, MayBeGraded)
{
  fem::SurfaceMesh mesh = fem::cylinder_side(1., 2., 20, 11);
  const auto turned = [](const Vector &x)
  {
    const double angle = std::atan2(x.y(), x.x());
    const double to = angle + 0.3 * std::sin(angle) * x.z();
    return Vector(std::cos(to), std::sin(to), x.z() * (4. - x.z()) / 4.);
  };
  for (Vector &node : mesh.nodes)
    node = turned(node);
  const fem::SurfaceMesh sheet = read(mesh);
  const Vector middle = 0.5 * (low + high);
  double nearest = 1.;
  for (const auto &quad : sheet.quads)
    for (std::size_t a = 0; a < 4; ++a)
      for (const double share : {0., 0.25, 0.5, 0.75})
        for (std::size_t b = 0; b < 4; ++b)
        {
          const Vector point =
              (1. - share) * sheet.nodes[static_cast<std::size_t>(quad[a])] +
              share * sheet.nodes[static_cast<std::size_t>(quad[b])];
          nearest = std::min(nearest, (point - middle).head<2>().norm());
        }
  const double radius = 0.5 * (high - low).x();
  EXPECT_GE(nearest, radius * (1. - 1e-12));
  EXPECT_LT(nearest, radius * 1.001);
  EXPECT_GT(volume(sheet), 0.);
}

TEST_F(SheetFile, SaysWhatDoesNotFit)
{
  const auto expect = [this](const fem::SurfaceMesh &mesh, const char *words)
  {
    const std::string said = refusal(mesh);
    EXPECT_NE(said.find(words), std::string::npos) << said;
    EXPECT_NE(said.find("Boundary/mesh = sheet.msh"), std::string::npos);
  };
  const fem::SurfaceMesh tube = fem::cylinder_side(1., 2., 20, 5);
  fem::SurfaceMesh other = tube;
  other.quads.pop_back();
  expect(other, "ends at");
  other = tube;
  other.nodes[50].head<2>() *= 0.99;
  expect(other, "from the z axis");
  expect(fem::cylinder_side(1., 2., 5, 5), "at most 60");
  expect(fem::cylinder_side(1., 2., 20, 1), "two rows");
  other = tube;
  for (Vector &node : other.nodes)
    node.x() += 3.;
  expect(other, "from the z axis");
  // Twice round.
  const auto n = static_cast<std::int32_t>(tube.nodes.size());
  other = tube;
  other.nodes.insert(other.nodes.end(), tube.nodes.begin(), tube.nodes.end());
  for (auto quad : tube.quads)
  {
    for (std::int32_t &node : quad)
      node += n;
    other.quads.push_back(quad);
  }
  expect(other, "go round once");
  base.specimen.form = SpecimenForm::box;
  expect(tube, "none of the four sides");
  std::ofstream(path()) << "no mesh\n";
  Case c = base;
  c.boundary.mesh = "sheet.msh";
  EXPECT_THROW(lateral_mesh(c, low, high), InputError);
  c.contents["Boundary/mesh"] = 1; // of another file
  EXPECT_THROW(lateral_mesh(c, low, high), InputError);
}
} // namespace
