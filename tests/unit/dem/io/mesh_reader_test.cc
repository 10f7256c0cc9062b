#include <dem/io/mesh_reader.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <utility>

using namespace dem;

namespace
{
class MeshReader : public testing::Test
{
protected:
  void SetUp() override
  {
    // One folder a test: ctest runs them side by side.
    folder = std::filesystem::path(testing::TempDir()) /
             testing::UnitTest::GetInstance()->current_test_info()->name();
    std::filesystem::create_directories(folder);
  }
  void TearDown() override { std::filesystem::remove_all(folder); }

  std::string write(const std::string &name, const std::string &text) const
  {
    const std::string path = (folder / name).string();
    std::ofstream(path) << text;
    return path;
  }

  std::string message_of(const std::string &path) const
  {
    try
    {
      read_mesh(path);
    }
    catch (const std::invalid_argument &error)
    {
      return error.what();
    }
    return "";
  }

  std::filesystem::path folder;
};

/// A tetrahedron with legs of length one.
const char *const stl = R"(solid t
facet normal 0 0 0
outer loop
vertex 0 0 0
vertex 0 1 0
vertex 1 0 0
endloop
endfacet
facet normal 0 0 0
outer loop
vertex 0 0 0
vertex 1 0 0
vertex 0 0 1
endloop
endfacet
facet normal 0 0 0
outer loop
vertex 0 0 0
vertex 0 0 1
vertex 0 1 0
endloop
endfacet
facet normal 0 0 0
outer loop
vertex 1 0 0
vertex 0 1 0
vertex 0 0 1
endloop
endfacet
endsolid t
)";

const char *const ply = R"(ply
format ascii 1.0
element vertex 4
property float x
property float y
property float z
element face 4
property list uchar int vertex_indices
end_header
0 0 0
1 0 0
0 1 0
0 0 1
3 0 2 1
3 0 1 3
3 0 3 2
3 1 2 3
)";

/// The same with a square base cut by the reader: a pyramid.
const char *const obj = R"(v 0 0 0
v 1 0 0
v 1 1 0
v 0 1 0
v 0.5 0.5 3
f 1 4 3 2
f 1 2 5
f 2 3 5
f 3 4 5
f 4 1 5
)";

const char *const bad_ply = "ply\nthis is no mesh\n";
} // namespace

TEST_F(MeshReader, ReadsStlPlyAndObj)
{
  EXPECT_NEAR(fit_shape(read_mesh(write("t.stl", stl)), 1).mesh_volume, 1. / 6.,
              1e-7);
  EXPECT_NEAR(fit_shape(read_mesh(write("t.PLY", ply)), 1).mesh_volume, 1. / 6.,
              1e-7);
  const TriangleMesh pyramid = read_mesh(write("t.obj", obj));
  EXPECT_EQ(pyramid.points.size(), 5u);
  EXPECT_EQ(pyramid.triangles.size(), 6u);
  EXPECT_NEAR(fit_shape(pyramid, 1).mesh_volume, 1., 1e-7);
}

TEST_F(MeshReader, SaysWhatIsWrongInOneLine)
{
  const auto expect = [&](const std::string &path, const std::string &word)
  {
    const std::string message = message_of(path);
    EXPECT_EQ(message.rfind(path, 0), 0u) << message;
    EXPECT_NE(message.find(word), std::string::npos) << message;
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
  };
  expect((folder / "none.stl").string(), "no such file");
  expect(folder.string(), "cannot be read");
  expect(write("t.step", stl), ".stl, .ply or .obj");
  expect(write("bare", stl), ".stl, .ply or .obj");
  for (const char *name : {"e.stl", "e.obj"})
  {
    expect(write(name, ""), "no triangles");
    expect(write(name, "this is no mesh\n"), "no triangles");
  }
  for (const char *vertex : {"v 2,5 0 0", "v nan 0 0", "v 1 0", "v a b c"})
    expect(write("v.obj", std::string(obj) + vertex + "\n"),
           "must be v and three numbers");
  expect(write("e.ply", ""), "ends within its header");
  expect(write("e.ply", "this is no mesh\n"), "does not begin with");
  expect(write("e.ply", bad_ply), "ends within its header");
}

// Cut at every third length, and every third byte spoilt: an error or a mesh,
// never a breakdown.
TEST_F(MeshReader, SurvivesCutAndSpoiltFiles)
{
  for (const auto &[name, text] :
       {std::pair("c.ply", ply), {"c.stl", stl}, {"c.obj", obj}})
    for (std::size_t i = 0; i < std::string(text).size(); i += 3)
    {
      message_of(write(name, std::string(text).substr(0, i)));
      std::string spoilt = text;
      spoilt[i] = '9';
      message_of(write(name, spoilt));
    }
  EXPECT_NE(message_of(write("c.ply", std::string(ply).substr(0, 180))), "");
}

TEST_F(MeshReader, ReadsBinaryPlyOfEitherByteOrder)
{
  for (const bool is_little : {true, false})
  {
    std::string text =
        std::string("ply\nformat binary_") + (is_little ? "little" : "big") +
        "_endian 1.0\nelement vertex 4\nproperty float x\nproperty double y\n"
        "property float z\nproperty uchar red\nelement face 4\n"
        "property list uchar int vertex_index\nend_header\n";
    const auto add = [&](auto value)
    {
      char bytes[sizeof value];
      std::memcpy(bytes, &value, sizeof value);
      if (is_little != (std::endian::native == std::endian::little))
        std::reverse(std::begin(bytes), std::end(bytes));
      text.append(bytes, sizeof value);
    };
    for (int i = 0; i < 4; ++i)
    {
      add(float(i == 1));
      add(double(i == 2));
      add(float(i == 3));
      add(std::uint8_t(200));
    }
    for (const auto &face :
         {std::array{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}})
    {
      add(std::uint8_t(3));
      for (const int corner : face)
        add(std::int32_t(corner));
    }
    const TriangleMesh mesh = read_mesh(write("b.ply", text));
    EXPECT_NEAR(fit_shape(mesh, 1).mesh_volume, 1. / 6., 1e-12);
  }
}
