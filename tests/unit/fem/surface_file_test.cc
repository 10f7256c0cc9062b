#include <fem/surface_file.h>

#include <gtest/gtest.h>

#include <cstdio>
#include <fstream>

namespace
{
using Vector = Eigen::Vector3d;

/// A file of the five sides of an open unit box, as these words say them.
struct File
{
  explicit File(const std::string &elements)
      : path(testing::TempDir() + "surface.msh")
  {
    std::ofstream(path) << "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n"
                           "$Nodes\n8\n"
                           "1 0 0 0\n2 1 0 0\n3 1 1 0\n4 0 1 0\n"
                           "5 0 0 1\n6 1 0 1\n7 1 1 1\n8 0 1 1\n"
                           "$EndNodes\n$Elements\n"
                        << elements << "$EndElements\n";
  }
  ~File() { std::remove(path.c_str()); }
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

TEST(SurfaceFile, RefusesWhatIsNoSurfaceOfQuads)
{
  EXPECT_NE(refusal("no/such/file.msh").find("cannot open"), std::string::npos);
  const File triangles("2\n1 2 2 1 1 1 2 3\n2 2 2 1 1 1 3 4\n");
  EXPECT_NE(refusal(triangles.path).find("recombine"), std::string::npos);
  std::ofstream(triangles.path) << "no mesh\n";
  EXPECT_NE(refusal(triangles.path).find("no gmsh file"), std::string::npos);
}
} // namespace
