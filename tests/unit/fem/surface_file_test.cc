#include "test_folder.h"

#include <fem/surface_file.h>

#include <gtest/gtest.h>

#include <fstream>

namespace
{
using Vector = Eigen::Vector3d;

/// A file of the five sides of an open unit box, as these words say them.
struct File
{
  explicit File(const std::string &elements)
      : path((support::test_folder() / "surface.msh").string())
  {
    std::ofstream(path) << "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n"
                           "$Nodes\n8\n"
                           "1 0 0 0\n2 1 0 0\n3 1 1 0\n4 0 1 0\n"
                           "5 0 0 1\n6 1 0 1\n7 1 1 1\n8 0 1 1\n"
                           "$EndNodes\n$Elements\n"
                        << elements << "$EndElements\n";
  }
  std::string path;
};

std::string refusal(const std::string &path)
{
  try
  {
    fem::read_surface_mesh(path);
  }
  catch (const std::invalid_argument &what)
  {
    return what.what();
  }
  return "";
}

/// Six times the volume between the quads and the middle of the box.
double six_volumes(const fem::SurfaceMesh &mesh)
{
  const Vector middle = Vector::Constant(0.5);
  double sum = 0.;
  for (const auto &quad : mesh.quads)
  {
    const auto at = [&](std::size_t corner) -> Vector
    { return mesh.nodes[static_cast<std::size_t>(quad[corner])] - middle; };
    sum += at(0).dot(at(1).cross(at(2))) + at(0).dot(at(2).cross(at(3)));
  }
  return sum;
}

// Two of the quads are written the other way round: all face alike in the end.
TEST(SurfaceFile, ReadsQuadsThatFaceAlike)
{
  const File file("5\n"
                  "1 3 2 1 1 1 2 6 5\n"
                  "2 3 2 1 1 2 6 7 3\n"
                  "3 3 2 1 1 3 4 8 7\n"
                  "4 3 2 1 1 4 8 5 1\n"
                  "5 3 2 1 1 1 4 3 2\n");
  const fem::SurfaceMesh mesh = fem::read_surface_mesh(file.path);
  EXPECT_EQ(mesh.nodes.size(), 8u);
  ASSERT_EQ(mesh.quads.size(), 5u);
  // Five of six pyramids over the sides of a unit cube.
  EXPECT_NEAR(std::abs(six_volumes(mesh)), 5., 1e-12);
}

/// The whole text of a file, and what is said about it.
std::string refusal_of_text(const std::string &text)
{
  const File file("");
  std::ofstream(file.path) << text;
  return refusal(file.path);
}

const char *const nodes = "1 0 0 0\n2 1 0 0\n3 1 1 0\n4 0 1 0\n"
                          "5 0 0 1\n6 1 0 1\n";

// Two quads that share an edge, in every format that gmsh has written.
TEST(SurfaceFile, ReadsAllFormatsAlike)
{
  const std::string four_nodes =
      "\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n0 0 1\n1 0 1\n$EndNodes\n";
  const std::string texts[] = {
      std::string("$NOD\n6\n") + nodes +
          "$ENDNOD\n$ELM\n2\n1 3 1 1 4 1 2 3 4\n"
          "2 3 1 1 4 1 2 6 5\n$ENDELM\n",
      std::string("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n1\n"
                  "2 1 \"a side\"\n$EndPhysicalNames\n$Nodes\n6\n") +
          nodes +
          "$EndNodes\n$Elements\n4\n1 15 2 0 1 1\n2 1 2 0 1 1 2\n"
          "3 3 2 1 1 1 2 3 4\n4 3 2 1 1 1 2 6 5\n$EndElements\n",
      std::string("$MeshFormat\n4 0 8\n$EndMeshFormat\n$Entities\n0 0 1 0\n"
                  "1 0 0 0 1 1 1 1 7 0\n$EndEntities\n$Nodes\n1 6\n"
                  "1 2 0 6\n") +
          nodes +
          "$EndNodes\n$Elements\n1 2\n1 2 3 2\n1 1 2 3 4\n"
          "2 1 2 6 5\n$EndElements\n",
      "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Entities\n1 0 1 0\n"
      "1 0 0 0 0\n1 0 0 0 1 1 1 1 7 2 1 -2\n$EndEntities\n"
      "$Nodes\n1 6 1 6\n2 1 0 6\n1\n2\n3\n4\n5\n6" +
          four_nodes +
          "$Elements\n1 2 1 2\n2 1 3 2\n1 1 2 3 4\n2 1 2 6 5\n"
          "$EndElements\n"};
  const File file("");
  for (const std::string &text : texts)
  {
    std::ofstream(file.path) << text;
    const fem::SurfaceMesh mesh = fem::read_surface_mesh(file.path);
    ASSERT_EQ(mesh.quads.size(), 2u);
    EXPECT_EQ(mesh.nodes.size(), 6u);
    Vector sum = Vector::Zero();
    for (const Vector &node : mesh.nodes)
      sum += node;
    EXPECT_EQ(sum, Vector(3., 2., 2.));
  }
}

TEST(SurfaceFile, RefusesWhatIsNoSurfaceOfQuads)
{
  EXPECT_NE(refusal("no/such/file.msh").find("cannot open"), std::string::npos);
  const File triangles("2\n1 2 2 1 1 1 2 3\n2 2 2 1 1 1 3 4\n");
  EXPECT_NE(refusal(triangles.path).find("recombine"), std::string::npos);
  EXPECT_NE(refusal_of_text("no mesh\n").find("not a gmsh file"),
            std::string::npos);
}

TEST(SurfaceFile, NamesWhatIsWrongAndTheLine)
{
  const auto expect = [](const std::string &elements, const std::string &word)
  {
    const std::string message = refusal(File(elements).path);
    EXPECT_NE(message.find(word), std::string::npos) << message;
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
  };
  expect("1\n1 16 2 1 1 1 2 3 4 5 6 7 8\n",
         "line 17: has quads of order 2 (8 nodes each): must be of order 1 "
         "(Mesh.ElementOrder = 1)");
  expect("1\n1 10 2 1 1 1 2 3 4 5 6 7 8 1\n", "quads of order 2 (9 nodes");
  expect("1\n1 36 2 1 1 1\n", "quads of order 3");
  expect("1\n1 999 2 1 1 1\n", "type 999");
  expect("1\n1 3 2 1 1 1 2 3 9\n", "names node 9, which is not there");
  expect("1\n1 3 2 1 1 1 2 3 3\n", "names node 3 twice");
  expect("3\n1 3 0 1 2 3 4\n2 3 0 1 2 6 5\n3 3 0 1 2 7 8\n",
         "an edge belongs to more than two quads");
  expect("2\n1 3 0 1 2 3 4\n", "line 18: \"$EndElements\"");
  expect("1\n1 3 0 1 2 3 4\n2 3 0 1 2 6 5\n", "must be $EndElements");
  expect("1\n1 3 0 1,5 2 3 4\n", "(a decimal comma: write 1.5)");
  expect("1\n1 5 0 1 2 3 4 5 6 7 8\n", "has hexahedra");
  expect("0\n", "has no quads");
}

// Files with counts like these took more than 30 s.
TEST(SurfaceFile, EndsWithTheFileWhateverItsCountsSay)
{
  const std::string start = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n";
  const std::string start_4 = "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n";
  for (const std::string &text :
       {start + "900000000000000\n" + nodes + "$EndNodes\n",
        start + "6\n" + nodes + "$EndNodes\n$Elements\n900000000000000\n",
        start_4 + "$Entities\n900000000000000 0 0 0\n$EndEntities\n",
        start_4 + "$Nodes\n900000000000000 1 1 1\n",
        start_4 + "$Nodes\n1 1 1 1\n2 1 0 900000000000000\n1\n0 0 0\n",
        start_4 + "$Elements\n1 1 1 1\n2 1 3 900000000000000\n"})
    EXPECT_NE(refusal_of_text(text).find("not a gmsh file"), std::string::npos);
  EXPECT_NE(refusal_of_text(start + "-1\n").find("from 0 on"),
            std::string::npos);
  EXPECT_NE(refusal_of_text("$MeshFormat\n4.1 1 8\n").find("Mesh.Binary = 0"),
            std::string::npos);
  EXPECT_NE(refusal_of_text("$MeshFormat\n3 0 8\n").find("must be 2 or 4"),
            std::string::npos);
  EXPECT_NE(refusal_of_text(start + "2\n1 0 0 0\n1 1 0 0\n")
                .find("node 1 is given twice"),
            std::string::npos);
}
} // namespace
