#include "compaction/scene.h"
#include "errors.h"
#include "specimen/obtained_gradation.h"
#include "subgrade/scene.h"
#include "test/test.h"
#include "test_folder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>

namespace
{
using namespace spall;
namespace fs = std::filesystem;

struct SieveTable
{
  const char *name, *rows;
};

constexpr SieveTable tables[] = {
    {"flat", "0.0001,0\n0.020,0\n0.025,1\n0.0315,1\n"},
    {"gap", "0.008,0\n0.010,0.1\n0.024,0.1\n0.026,1\n"},
    {"uniform", "0.016,0\n0.020,1\n"},
    {"single_size", "0.020,0\n0.02001,1\n"},
    {"long", "0.000063,0\n0.001,0\n0.004,0\n0.008,0\n0.0112,0.1\n0.016,0.35\n"
             "0.020,0.6\n0.025,0.85\n0.0315,1\n0.045,1\n0.063,1\n"}};

/// Every kind that reads a gradation, with spheres and with shapes.
class GradationOfKinds : public testing::Test
{
protected:
  void SetUp() override
  {
    folder = support::test_folder();
    shapes = SPALL_SHAPES_DIR "/limestone_blocky";
  }

  std::string file_of(const SieveTable &table) const
  {
    const fs::path path = folder / (std::string(table.name) + ".csv");
    std::ofstream(path) << "diameter_m,passing_1\n" << table.rows;
    return path.string();
  }

  Case case_of(const std::string &kind, const std::string &table,
               const std::string &its_shapes) const
  {
    Case c;
    c.kind = kind;
    c.file = (folder / "case.prm").string();
    c.specimen.gradation = c.charge.gradation = c.filling.gradation =
        c.subgrade.layer.gradation = table;
    c.specimen.shapes = c.charge.shapes = c.filling.shapes =
        c.subgrade.layer.shapes = its_shapes;
    c.specimen.side = 0.13;
    c.charge.mass = 3.;
    c.charge.balls = 1;
    c.charge.ball_mass = 0.4;
    c.container.diameter = c.container.height = 0.13;
    c.subgrade.layer.length = c.subgrade.layer.width = 0.16;
    c.subgrade.layer.thickness = 0.08;
    return c;
  }

  fs::path folder;
  std::string shapes;
};

/// The particles of a case as its test makes them.
dem::ParticleSystem drawn(const Case &c)
{
  // Without what surrounds them, which takes longer.
  if (c.kind == "dynamic_triaxial")
    return make_specimen(c).engine->particles();
  if (c.kind == "vibratory_compaction")
    return make_compaction_scene(c).all;
  if (c.kind == "subgrade")
    return make_particle_box(c).all;
  dem::ParticleSystem copy;
  make_test(c)->with_all_particles([&copy](const dem::ParticleSystem &particles)
                                   { copy = particles; });
  return copy;
}

/// Share of the mass in particles of at most this diameter [-].
double passing(const dem::ParticleSystem &particles, double diameter)
{
  double finer = 0., all = 0.;
  for (std::size_t i = 0; i < particles.size(); ++i)
    if (particles.material[i] == 0)
    {
      all += particles.mass(i);
      if (2. * particles.radius(i) <= diameter * (1. + 1e-9))
        finer += particles.mass(i);
    }
  return finer / all;
}

constexpr const char *kinds[] = {"dynamic_triaxial", "los_angeles",
                                 "vibratory_compaction", "subgrade"};
} // namespace

// The mass of one particle of the size of a sieve is the tolerance; the shapes
// here have at most 1.1 of the volume of their spheres. Between sieves a class
// is filled at random: that is 1/40 of the mass of the largest interval.
TEST_F(GradationOfKinds, SievesPassWhatTheTableAsks)
{
  for (const std::string kind : kinds)
    for (const SieveTable &table : tables)
      for (const std::string &its_shapes : {std::string(), shapes})
      {
        const Case c = case_of(kind, file_of(table), its_shapes);
        const Gradation sieves = read_gradation(c.specimen.gradation);
        const dem::ParticleSystem particles = drawn(c);
        const auto found = obtained_gradation(c, particles);
        ASSERT_TRUE(found);
        const std::string where =
            std::string(table.name) + ", kind " + kind + ", " + its_shapes;
        for (std::size_t k = 0; k < found->diameter.size(); ++k)
        {
          const double diameter = found->diameter[k];
          const bool is_sieve = std::ranges::find(sieves.diameter, diameter) !=
                                sieves.diameter.end();
          EXPECT_NEAR(found->obtained[k], found->asked[k],
                      1.1 * found->one_particle[k] + (is_sieve ? 0. : 0.025))
              << where << ", " << diameter << " m";
          EXPECT_NEAR(found->obtained[k], passing(particles, diameter), 1e-12);
        }
        EXPECT_EQ(found->obtained.back(), 1.) << where;
      }
}

TEST_F(GradationOfKinds, TableHoldsEverySieve)
{
  const Case c = case_of("vibratory_compaction", file_of(tables[1]), "");
  const auto found = obtained_gradation(c, drawn(c));
  ASSERT_TRUE(found);
  for (const auto &[diameter, asked] :
       {std::pair{0.008, 0.}, {0.010, 0.1}, {0.024, 0.1}, {0.026, 1.}})
  {
    const auto row = std::ranges::find(found->diameter, diameter);
    ASSERT_NE(row, found->diameter.end()) << diameter;
    EXPECT_NEAR(found->asked[std::size_t(row - found->diameter.begin())], asked,
                1e-15);
  }
  std::istringstream text(gradation_table(*found));
  std::string header;
  std::getline(text, header);
  EXPECT_EQ(header,
            "diameter_m,asked_passing_1,obtained_passing_1,one_particle_1");
}

TEST_F(GradationOfKinds, MessagesNameTheUnit)
{
  const std::string path = file_of({"mm", "2,0\n8,1\n"});
  Case c = case_of("dynamic_triaxial", path, "");
  c.specimen.side = 40.;
  const std::string line =
      gradation_line(obtained_gradation(c, drawn(c)).value());
  EXPECT_NE(line.find("from 2000 to 8000 mm"), std::string::npos) << line;
  EXPECT_NE(line.find("WARNING"), std::string::npos) << line;
  c.specimen.gradation = file_of({"sand", "0.00063,0\n0.002,1\n"});
  try
  {
    make_specimen(c);
    FAIL() << "too many particles must be refused";
  }
  catch (const InputError &error)
  {
    EXPECT_NE(std::string(error.what()).find("must be in m"), std::string::npos)
        << error.what();
  }
}
