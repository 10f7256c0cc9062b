#include "test_folder.h"

#include <dem/io/mesh_reader.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cctype>
#include <cstdint>
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
  void SetUp() override { folder = support::test_folder(); }

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
  for (const char *text : {"", "this is no mesh\n"})
  {
    expect(write("e.obj", text), "no triangles");
    expect(write("e.stl", text), "is not an STL file");
  }
  expect(write("e.stl", "solid t\nendsolid t\n"), "no triangles");
  expect(write("v.obj", std::string(obj) + "v 2,5 0 0\n"),
         "(a decimal comma: write 2.5)");
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

// Numbers beyond the vertices broke the reader of VTK down.
TEST_F(MeshReader, RefusesFacesOfObjWithoutTheirVertices)
{
  const std::string vertices = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";
  const auto expect = [&](const std::string &face, const std::string &word)
  {
    const std::string message = message_of(write("f.obj", vertices + face));
    EXPECT_NE(message.find("line 5"), std::string::npos) << message;
    EXPECT_NE(message.find(word), std::string::npos) << message;
  };
  expect("f 4 1 5 1000008", "vertex 1000008, the file has 4");
  expect("f 1 2 5\nf 1 2 3", "vertex 5, the file has 4");
  expect("f 1 2 0", "vertex 0");
  expect("f 1 2 -5", "vertex -5");
  expect("f 1 2 3000000000", "vertex 3000000000");
  expect("f 1 2 99999999999999999999", "vertex 99999999999999999999");
  expect("f 1 2 -99999999999999999999", "vertex -99999999999999999999");
  expect("f 1 2 3.5", "numbers of vertices");
  expect("f 1//1 2//1 /3", "numbers of vertices");
  expect("f 1 2", "has 2 corners");
  expect("f 1 \\\n 2", "has 2 corners");
}

TEST_F(MeshReader, CountsNegativeNumbersOfObjBack)
{
  const TriangleMesh forward = read_mesh(write("p.obj", obj));
  std::string text = obj;
  text.replace(text.find("f 1 4 3 2"), 9, "f -5/7/2 -2//1 -3/1 -4 # base");
  text.replace(text.find("f 4 1 5"), 7, "f 4 1 \\\n-1");
  EXPECT_EQ(read_mesh(write("n.obj", text)).triangles, forward.triangles);
}

// The middle of the L is seen from its inner corner alone: triangles of a fan
// would lie upon each other.
TEST_F(MeshReader, CutsPolygonsThatAreNotConvex)
{
  std::string text;
  const int rim[6][2] = {{2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}, {0, 0}};
  for (const int z : {0, 1})
    for (const auto &corner : rim)
      text += "v " + std::to_string(corner[0]) + " " +
              std::to_string(corner[1]) + " " + std::to_string(z) + "\n";
  text += "f 6 5 4 3 2 1\nf 7 8 9 10 11 12\n";
  for (int k = 0; k < 6; ++k)
  {
    const int next = (k + 1) % 6;
    text += "f " + std::to_string(k + 1) + " " + std::to_string(next + 1) +
            " " + std::to_string(next + 7) + " " + std::to_string(k + 7) + "\n";
  }
  const ShapeFit fit = fit_shape(read_mesh(write("l.obj", text)), 1);
  EXPECT_NEAR(fit.mesh_volume, 3., 1e-12);
  EXPECT_NEAR(fit.mesh_area, 14., 1e-12);
}

namespace
{
/// The tetrahedron as a binary STL whose header promises so many triangles.
std::string binary_stl(std::uint32_t promised)
{
  std::string bytes(80, ' ');
  const auto add = [&bytes](auto value)
  { bytes.append(reinterpret_cast<const char *>(&value), sizeof value); };
  add(promised); // of a machine with the byte order of the format
  const float p[4][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  for (const auto &face :
       {std::array{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}})
  {
    bytes.append(12, '\0');
    for (const int corner : face)
      for (const float x : p[corner])
        add(x);
    bytes.append(2, '\x11'); // colour
  }
  return bytes;
}
} // namespace

TEST_F(MeshReader, CountsTrianglesOfBinaryStl)
{
  std::string sound = binary_stl(4);
  EXPECT_NEAR(fit_shape(read_mesh(write("b.stl", sound)), 1).mesh_volume,
              1. / 6., 1e-12);
  sound.replace(0, 5, "solid"); // some programs begin so
  EXPECT_EQ(read_mesh(write("b.stl", sound)).triangles.size(), 4u);
  for (const std::uint32_t promised : {0u, 3u, 5u, 0x7fffffffu, 0xffffffffu})
  {
    const std::string message =
        message_of(write("b.stl", binary_stl(promised)));
    EXPECT_NE(message.find("promises " + std::to_string(promised) +
                           " triangles, the file of 284 bytes has room for 4"),
              std::string::npos)
        << message;
  }
  const std::string cut = message_of(write("b.stl", sound.substr(0, 200)));
  EXPECT_NE(cut.find("has room for 2: is it cut off?"), std::string::npos)
      << cut;
}

TEST_F(MeshReader, SaysWhatIsWrongWithTheTextOfAnStl)
{
  const std::string text = stl;
  const auto expect = [&](const std::string &changed, const std::string &word)
  {
    const std::string message = message_of(write("t.stl", changed));
    EXPECT_NE(message.find(word), std::string::npos) << message;
  };
  const auto replaced = [&](const std::string &from, const std::string &to)
  { return std::string(text).replace(text.find(from), from.size(), to); };
  expect(text.substr(0, text.find("endsolid")),
         "ends after line 29 without endsolid, 4 triangles: is it cut off?");
  expect(text.substr(0, text.find("endfacet")), "without endsolid");
  expect(replaced("vertex 0 1 0", "vertex 0,5 1 0"),
         "line 5: \"vertex 0,5 1 0\": must be vertex and three numbers (a "
         "decimal comma: write 0.5)");
  expect(replaced("vertex 0 1 0\n", ""), "a facet of 2 corners");
  expect(replaced("vertex 0 1 0\n", "edge\n"), "line 5: \"edge\": must be");
  std::string loud = text;
  for (char &c : loud)
    c = char(std::toupper(c));
  EXPECT_EQ(read_mesh(write("u.stl", loud + text)).triangles.size(), 8u);
}

// A header without an end of its last line was read beyond the bytes.
TEST_F(MeshReader, StopsAtTheEndOfTheHeaderOfAPly)
{
  const std::string message = message_of(
      write("h.ply", "ply\nformat binary_little_endian 1.0\nelement vertex 1\n"
                     "property float x\nend_header"));
  EXPECT_NE(message.find("ends before its last triangle"), std::string::npos)
      << message;
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
