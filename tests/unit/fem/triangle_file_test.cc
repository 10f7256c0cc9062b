#include "test_folder.h"

#include <fem/triangle_file.h>

#include <gtest/gtest.h>

#include <fstream>
#include <stdexcept>

namespace
{
/// Two triangles of a unit square and a quad beside it, with elements that are
/// no surfaces and gaps in the numbers of the nodes.
const std::string format_2 =
    "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n"
    "$Nodes\n6\n1 0 0 0\n2 1 0 0\n3 1 1 0\n4 0 1 0\n9 2 0 0\n12 2 1 0\n"
    "$EndNodes\n$Elements\n4\n1 1 2 0 1 1 2\n2 2 2 0 1 1 2 3\n"
    "3 2 2 0 1 1 3 4\n4 3 2 0 1 2 9 12 3\n$EndElements\n";
const std::string format_4 =
    "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n"
    "$Nodes\n2 6 1 12\n2 1 0 4\n1\n2\n3\n4\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n"
    "2 2 0 2\n9\n12\n2 0 0\n2 1 0\n$EndNodes\n"
    "$Elements\n3 4 1 4\n1 1 1 1\n1 1 2\n2 1 2 2\n2 1 2 3\n3 1 3 4\n"
    "2 2 3 1\n4 2 9 12 3\n$EndElements\n";

fem::Triangles read(const std::string &text)
{
  const std::string path = (support::test_folder() / "triangles.msh").string();
  std::ofstream(path) << text;
  return fem::read_triangles(path);
}
} // namespace

TEST(TriangleFile, TrianglesAndQuadsOfBothFormats)
{
  for (const std::string &text : {format_2, format_4})
  {
    const fem::Triangles mesh = read(text);
    EXPECT_EQ(mesh.nodes.size(), 6u);
    ASSERT_EQ(mesh.corners.size(), 4u);
    double area = 0.;
    for (const auto &corner : mesh.corners)
    {
      const auto at = [&](std::size_t c)
      { return mesh.nodes[static_cast<std::size_t>(corner[c])]; };
      const Eigen::Vector3d twice = (at(1) - at(0)).cross(at(2) - at(0));
      EXPECT_GT(twice.z(), 0.);
      area += 0.5 * twice.z();
    }
    EXPECT_DOUBLE_EQ(area, 2.);
  }
}

TEST(TriangleFile, FilesWithoutSurfacesAreRefused)
{
  EXPECT_THROW(read("solid stl"), std::invalid_argument);
  EXPECT_THROW(read("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n"
                    "$Nodes\n1\n1 0 0 0\n$EndNodes\n"),
               std::invalid_argument);
}
