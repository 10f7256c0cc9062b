#include "errors.h"
#include "shape/file.h"
#include "test_folder.h"

#include <dem/shape/quadrature.h>

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>

using namespace spall;

namespace
{
class ShapeFiles : public testing::Test
{
protected:
  void SetUp() override { folder = support::test_folder(); }

  std::string write(const std::string &text) const
  {
    const std::string path = (folder / "s.json").string();
    std::ofstream(path) << text;
    return path;
  }

  void expect_error(const std::string &text, const std::string &word) const
  {
    const std::string path = write(text);
    try
    {
      read_shape(path);
      ADD_FAILURE() << "accepted: " << text;
    }
    catch (const InputError &error)
    {
      const std::string message = error.what();
      EXPECT_EQ(message.rfind(path, 0), 0u) << message;
      EXPECT_NE(message.find(word), std::string::npos) << message;
      EXPECT_EQ(message.find('\n'), std::string::npos) << message;
    }
  }

  std::filesystem::path folder;
};

std::string shape_text(const std::string &order, const std::string &list,
                       const std::string &unit = "\"mm\"")
{
  return R"({"order": )" + order +
         R"(, "convention": "real orthonormal, no Condon-Shortley",)"
         R"( "unit": )" +
         unit + R"(, "coefficients": )" + list + "}";
}
} // namespace

TEST_F(ShapeFiles, AreReadBackAsWritten)
{
  ShapeFile shape;
  shape.order = 2;
  shape.coefficients = {0.03,      1e-3, -2e-3 / 3., 0.,   1e-4,
                        1e-5 / 7., 2e-4, 0.,         -1e-4};
  shape.name = "a \"particle\"";
  shape.source = "test";
  shape.licence = "MIT";
  const std::string path = (folder / "s.json").string();
  write_shape(path, shape);
  const ShapeFile again = read_shape(path);
  EXPECT_EQ(again.order, 2);
  EXPECT_EQ(again.coefficients, shape.coefficients);
  EXPECT_EQ(again.name, shape.name);
  EXPECT_EQ(again.source, shape.source);
  EXPECT_EQ(again.licence, shape.licence);
  EXPECT_THROW(write_shape((folder / "no" / "s.json").string(), shape),
               InputError);
}

TEST_F(ShapeFiles, AreInMetresWhateverTheUnit)
{
  EXPECT_DOUBLE_EQ(read_shape(write(shape_text("0", "[2]"))).coefficients[0],
                   2e-3);
  EXPECT_DOUBLE_EQ(
      read_shape(write(shape_text("0", "[2]", "\"um\""))).coefficients[0],
      2e-6);
}

TEST_F(ShapeFiles, SayWhatIsWrong)
{
  expect_error("{", "valid JSON");
  expect_error("[]", "not a JSON object");
  expect_error("{}", "\"order\" is missing");
  expect_error(R"({"order": 1})", "\"convention\" is missing");
  expect_error(shape_text("31", "[1]"), "0 .. 30");
  expect_error(shape_text("-1", "[1]"), "0 .. 30");
  expect_error(shape_text("1.5", "[1]"), "0 .. 30");
  expect_error(shape_text("1", "[1, 0, 0]"), "3 entries, order 1 has 4");
  expect_error(shape_text("1", "7"), "coefficients");
  expect_error(shape_text("1", "[1, 0, null, 0]"), "coefficients[2] is null");
  expect_error(shape_text("0", "[1e999]"), "JSON");
  expect_error(shape_text("0", "[1]", "\"inch\""), "m, mm or um");
  expect_error(shape_text("0", "[1]", "1"), "unit");
  expect_error(shape_text("0", "[-1]"), "not above zero");
  expect_error(R"({"order": 0, "convention": "complex"})", "convention");
}

TEST_F(ShapeFiles, FolderIsReadInTheOrderOfNames)
{
  EXPECT_THROW(read_shapes((folder / "none").string()), InputError);
  EXPECT_THROW(read_shapes(folder.string()), InputError);
  for (const char *name : {"b", "a", "c"})
  {
    std::ofstream(folder / (std::string(name) + ".json"))
        << shape_text("0", "[1]");
  }
  std::ofstream(folder / "readme.txt") << "no shape";
  const std::vector<ShapeFile> shapes = read_shapes(folder.string());
  ASSERT_EQ(shapes.size(), 3u);
  EXPECT_EQ(shapes[0].name, "a");
  EXPECT_EQ(shapes[2].name, "c");
}

std::vector<ShapeFile> committed_shapes()
{
  std::vector<ShapeFile> shapes = read_shapes(SPALL_SHAPES_DIR "/limestone");
  for (const ShapeFile &shape :
       read_shapes(SPALL_SHAPES_DIR "/limestone_blocky"))
    shapes.push_back(shape);
  return shapes;
}

// Volumes of the source's own table [mm^3]. The meshes were built from its
// coefficients up to degree 14, which take up to 0.45 % less; the facets of the
// meshes are 0.5 to 1.3 % below the table.
TEST(CommittedShapes, HaveTheVolumesOfTheSource)
{
  const std::vector<ShapeFile> shapes = committed_shapes();
  const double source[] = {2776.5, 1401.9, 1707.7, 126.6,
                           570.2,  762.3,  1192.7, 1140.4};
  ASSERT_EQ(shapes.size(), std::size(source));
  for (std::size_t i = 0; i < shapes.size(); ++i)
  {
    EXPECT_EQ(shapes[i].order, 20);
    EXPECT_NE(shapes[i].licence.find("MIT"), std::string::npos);
    EXPECT_NE(shapes[i].source.find("NIST"), std::string::npos);
    const double volume = dem::shape_of(shapes[i].coefficients).volume;
    EXPECT_LT(volume, 1.0005 * source[i] * 1e-9); // the table has four digits
    EXPECT_GT(volume, 0.993 * source[i] * 1e-9);
  }
}

// The bounds of a body hold on a rule 25 times finer than the nodes
// they come from.
TEST(CommittedShapes, StayInsideTheBoundsOfTheirBodies)
{
  const dem::SphereQuadrature fine = dem::make_quadrature(200, 400);
  for (const ShapeFile &shape : committed_shapes())
  {
    const dem::ParticleShape body = dem::shape_of(shape.coefficients);
    for (const dem::Vec3 &s : fine.direction)
    {
      const dem::RadialExpansion at = dem::expand(shape.coefficients, s);
      ASSERT_LE(at.radius, body.circumscribed_radius) << shape.name;
      ASSERT_LE(at.gradient.norm(), body.max_slope) << shape.name;
    }
  }
}
