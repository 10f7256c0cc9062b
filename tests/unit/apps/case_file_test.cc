#include "case/fields.h"
#include "case/file.h"
#include "errors.h"
#include "test_folder.h"

#include <dem/io/table_file.h>

#include <gtest/gtest.h>

#include <array>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <set>

namespace
{
using namespace spall;
namespace fs = std::filesystem;

/// A folder with a gradation, for cases of spheres.
class CaseFile : public testing::Test
{
protected:
  void SetUp() override
  {
    folder = support::test_folder();
    fs::create_directories(folder / "shapes");
    write("g.csv", "diameter_m,passing_1\n0.008,0\n0.016,1\n");
  }

  std::string write(const std::string &name, const std::string &text)
  {
    std::ofstream(folder / name) << text;
    return (folder / name).string();
  }

  /// A sound case with more sections.
  std::string write_case(const std::string &more)
  {
    return write("case.prm", "subsection Specimen\n  set gradation = g.csv\n"
                             "  set shapes =\nend\n" +
                                 more +
                                 "subsection Coupling\n"
                                 "  set exchange = every_step\nend\n");
  }

  fs::path folder;
};

std::string message_of(const std::string &file)
{
  try
  {
    read_case(file, {});
  }
  catch (const InputError &error)
  {
    return error.what();
  }
  return "";
}

TEST_F(CaseFile, KeepsDefaultsAndTakesValues)
{
  const Case c = read_case(
      write_case("subsection Loading\n  set cycles = 3 # few\nend\n"
                 "subsection Boundary\n  set lateral = rigid\nend\n"
                 "subsection Breakage\n  set is_active = false\nend\n"),
      {});
  EXPECT_EQ(c.loading.cycles, 3);
  EXPECT_EQ(c.boundary.lateral, Lateral::rigid);
  EXPECT_FALSE(c.breakage.is_active);
  EXPECT_EQ(c.loading.frequency, LoadingParameters().frequency);
  EXPECT_EQ(c.specimen.shapes, "");
}

// As some editors write it: a mark of three bytes, lines that end in \r\n.
TEST_F(CaseFile, ByteOrderMarkIsPassedOver)
{
  EXPECT_EQ(read_case(write("mark.prm", "\xEF\xBB\xBFsubsection Case\r\n"
                                        "  set kind = single_particle\r\n"
                                        "end\r\n"),
                      {})
                .kind,
            "single_particle");
}

TEST_F(CaseFile, CommandLineWinsOverCaseOverMaterial)
{
  write("m.prm", "subsection Particle\n  set density = 2000\n"
                 "  set friction = 0.3\n  set shear_damping = 0.1\nend\n");
  const std::string file =
      write_case("subsection Material\n  set file = m.prm\nend\n"
                 "subsection Particle\n  set friction = 0.4\n"
                 "  set shear_damping = 0.2\nend\n");
  const std::vector<Override> overrides = {
      parse_override("Particle/shear_damping=0.3")};
  const Case c = read_case(file, overrides);
  EXPECT_EQ(c.particle.density, 2000.);
  EXPECT_EQ(c.particle.friction, 0.4);
  EXPECT_EQ(c.particle.shear_damping, 0.3);
  EXPECT_EQ(c.particle.shear_modulus, dem::ParticleMaterial().shear_modulus);
}

// There is no silent way of exchange, and no impossible one.
TEST_F(CaseFile, ExchangeMustBeSaid)
{
  const std::string plain =
      write("case.prm", "subsection Specimen\n  set gradation = g.csv\n"
                        "  set shapes =\nend\n");
  EXPECT_NE(message_of(plain).find("Coupling/exchange = none"),
            std::string::npos);
  const auto with = [&](const std::string &keys)
  {
    return message_of(
        write("case.prm", "subsection Specimen\n  set gradation = g.csv\n"
                          "  set shapes =\nend\nsubsection Coupling\n" +
                              keys + "end\n"));
  };
  const std::string every_step = "  set exchange = every_step\n";
  EXPECT_NE(with(every_step + "  set particle_steps = 2\n")
                .find("Coupling/particle_steps = 2"),
            std::string::npos);
  EXPECT_NE(with(every_step + "  set body_time = implicit\n")
                .find("Coupling/body_time"),
            std::string::npos);
  EXPECT_EQ(with("  set exchange = iterated\n  set particle_steps = 2\n"
                 "  set body_time = implicit\n"),
            "");
}

TEST_F(CaseFile, JsonGivesTheSameCase)
{
  const std::string json =
      write("case.json", R"({"Specimen": {"gradation": "g.csv", "shapes": "",
                                    "solid_fraction": 0.5},
                       "Coupling": {"exchange": "one_pass"},
                       "Breakage": {"is_active": false}})");
  const std::string prm =
      write("case.prm", "subsection Specimen\n  set gradation = g.csv\n"
                        "  set shapes =\n  set solid_fraction = 0.5\nend\n"
                        "subsection Coupling\n"
                        "  set exchange = one_pass\nend\n"
                        "subsection Breakage\n  set is_active = false\nend\n");
  Case a = read_case(json, {}), b = read_case(prm, {});
  a.file = b.file;
  EXPECT_EQ(resolved_case(a), resolved_case(b));
}

// Every value, changed from its default, must survive printing and reading.
TEST_F(CaseFile, ResolvedCaseReadsBackTheSame)
{
  Case c = read_case(write_case(""), {});
  for (const Parameter &p : parameters_of(c))
    if (auto *number = std::get_if<double *>(&p.value))
    {
      const double other = **number * (1. - 1. / 3.);
      if (p.range.contains(other))
        **number = other;
    }
    else if (const auto *choice = std::get_if<Choice>(&p.value);
             choice && p.key != "kind")
      choice->set(choice->names.size() - 1);
  c.breakage.min_equivalent_radius = 1e-3 / 3.;
  c.specimen.shapes = "shapes";
  c.particle.law = c.wall.law = "linear"; // the last does not go with surfaces
  c.loading.form = LoadForm::compression; // a path needs its file
  c.boundary.lateral = Lateral::rigid;    // periodic sides need a box
  if (dem::hdf5_version().empty())        // and tables need HDF5
    c.output.frame_tables = FrameTables::none;
  const std::string printed = resolved_case(c);
  Case again = read_case(write("resolved.prm", printed), {});
  EXPECT_EQ(again.specimen.shapes, (folder / "shapes").string());
  again.file = c.file;
  EXPECT_EQ(resolved_case(again), printed);
  EXPECT_EQ(again.specimen.side, c.specimen.side); // bit for bit
}

TEST_F(CaseFile, TemplateIsASoundCase)
{
  setenv("SPALL_DATA_DIR", folder.c_str(), 1);
  fs::create_directories(folder / "gradations");
  fs::copy(folder / "g.csv", folder / "gradations/quick_7_22mm.csv");
  fs::create_directories(folder / "shapes/limestone_blocky");
  const std::string file =
      write("template.prm", template_case("dynamic_triaxial"));
  EXPECT_EQ(message_of(file), "");
  unsetenv("SPALL_DATA_DIR");
}

TEST_F(CaseFile, EveryKindHasASoundTemplate)
{
  for (const std::string &kind : kind_names())
  {
    const std::string file = write(kind + ".prm", template_case(kind));
    EXPECT_EQ(message_of(file), "") << kind;
    const Case c = read_case(file, {});
    EXPECT_EQ(c.kind, kind);
    const auto body = [](const std::string &text)
    { return text.substr(text.find("subsection Case")); };
    const Case again = read_case(write("again.prm", resolved_case(c)), {});
    EXPECT_EQ(body(resolved_case(again)), body(resolved_case(c))) << kind;
  }
}

TEST_F(CaseFile, SectionsOfOtherKindsAreRefused)
{
  const std::string message =
      message_of(write("press.prm", "subsection Case\n"
                                    "  set kind = single_particle\nend\n"
                                    "subsection Drum\n"
                                    "  set turns = 3\nend\n"));
  EXPECT_NE(message.find("press.prm:5: Drum/turns: a case of kind "
                         "single_particle has no section Drum"),
            std::string::npos)
      << message;
}

TEST_F(CaseFile, EveryParameterIsDescribedOnce)
{
  Case c;
  c.walls.emplace_back().name = "floor";
  std::set<std::string> seen, known;
  for (const Section &section : sections(c))
    known.insert(section.name);
  for (const Parameter &p : parameters_of(c))
  {
    const std::string name = p.section + "/" + p.key;
    EXPECT_TRUE(seen.insert(name).second) << name;
    EXPECT_TRUE(known.contains(p.section)) << name;
    EXPECT_FALSE(p.unit.empty()) << name;
    EXPECT_TRUE(p.sentence.ends_with('.')) << name;
    EXPECT_NO_THROW(assign(p, value_text(p))) << name; // the default
  }
}

// Sections of walls are nested in files and have one name elsewhere; what a
// wall does not say is that of section Wall.
TEST_F(CaseFile, WallsAreNestedSections)
{
  write("p.csv", "x,y,z,radius\n0,0,0,0.01\n");
  const std::string start = "subsection Case\n  set kind = scene\nend\n"
                            "subsection Scene\n  set particles = p.csv\nend\n"
                            "subsection Wall\n  set friction = 0.7\nend\n";
  const std::string prm =
      write("walls.prm", start + "subsection Walls\n  subsection floor\n"
                                 "    set mesh = floor.obj\n"
                                 "    set velocity = 0, 0, 1.5\n  end\n"
                                 "  subsection lid\n    set mesh = lid.obj\n"
                                 "    set friction = 0.1\n"
                                 "    set free = yz\n  end\nend\n");
  const std::string json =
      write("walls.json",
            R"({"Case": {"kind": "scene"}, "Scene": {"particles": "p.csv"},
          "Wall": {"friction": 0.7},
          "Walls": {"floor": {"mesh": "floor.obj", "velocity": [0, 0, 1.5]},
                    "lid": {"mesh": "lid.obj", "friction": 0.1,
                            "free": "yz"}}})");
  write("floor.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  write("lid.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  for (const std::string &file : {prm, json})
  {
    const std::array<Override, 1> mass{parse_override("Walls/lid/mass=2.5")};
    const Case c = read_case(file, mass);
    ASSERT_EQ(c.walls.size(), 2u);
    EXPECT_EQ(c.walls[0].name, "floor");
    EXPECT_EQ(c.walls[0].velocity, dem::Vec3(0., 0., 1.5));
    EXPECT_EQ(c.walls[0].material.friction, 0.7);
    EXPECT_EQ(c.walls[1].material.friction, 0.1);
    EXPECT_EQ(c.walls[1].free, FreeDirections::yz);
    EXPECT_EQ(c.walls[1].mass, 2.5);
    const Case again = read_case(write("again.prm", resolved_case(c)), {});
    EXPECT_EQ(without_comments(resolved_case(again)),
              without_comments(resolved_case(c)));
  }
}

TEST_F(CaseFile, FaultsNameTheirSource)
{
  const std::string file =
      write_case("subsection Particle\n  set friction = -1\nend\n");
  EXPECT_EQ(message_of(file),
            file + ":6: Particle/friction = -1: must be a number of at least 0 "
                   "and at most 10");
}

TEST_F(CaseFile, PathsAreSoughtBesideTheCaseFirst)
{
  const Case c = read_case(write_case(""), {});
  EXPECT_EQ(find_path(c, "Specimen", "gradation", "g.csv"),
            (folder / "g.csv").string());
  EXPECT_EQ(find_path(c, "Specimen", "gradation", c.file), c.file);
  EXPECT_THROW(find_path(c, "Specimen", "gradation", "none.csv"), InputError);
}

// Over the case and below what the command line says itself.
// The resolved case gives the path from the root, through a folder whose name
// would begin a comment.
TEST_F(CaseFile, PathsAndTitlesMayHoldAnySign)
{
  const std::string lot = "lot #2 \"wet\"";
  fs::create_directories(folder / lot / "shapes#1");
  write(lot + "/g.csv", "diameter_m,passing_1\n0.008,0\n0.016,1\n");
  const std::string text =
      "subsection Case\n  set title = \"a \"\"quick\"\" test, # 3 \" # plain\n"
      "end\nsubsection Specimen\n  set gradation = g.csv\n"
      "  set shapes = \"shapes#1\"\nend\nsubsection Coupling\n"
      "  set exchange = every_step\nend\n";
  const Case c = read_case(write(lot + "/case.prm", text), {});
  EXPECT_EQ(c.title, "a \"quick\" test, # 3 ");
  EXPECT_EQ(c.specimen.shapes, "shapes#1");
  const Case again = read_case(write("resolved.prm", resolved_case(c)), {});
  EXPECT_EQ(again.title, c.title);
  EXPECT_EQ(again.specimen.gradation, (folder / lot / "g.csv").string());
  EXPECT_EQ(again.specimen.shapes, (folder / lot / "shapes#1").string());
  EXPECT_EQ(without_comments(resolved_case(again)),
            without_comments(resolved_case(c)));
}

// It used to be read as the folder `shapes`, in silence.
TEST_F(CaseFile, ASignOfCommentsInAValueIsRefused)
{
  const std::string file = write("case.prm", "subsection Specimen\n"
                                             "  set shapes = shapes#1\nend\n");
  EXPECT_NE(
      message_of(file).find(":2: cannot read \"set shapes = shapes#1\": a "
                            "value with # must be in double quotes"),
      std::string::npos)
      << message_of(file);
  EXPECT_EQ(read_case(write_case("subsection Case\n  set title = \"a\" and b\n"
                                 "end\n"),
                      {})
                .title,
            "\"a\" and b");
}

TEST_F(CaseFile, PresetsAreOverTheCase)
{
  const std::string file = write_case(
      "subsection Time\n  set step = fixed\n  set safety = 0.5\nend\n");
  const std::vector<Override> fast = {parse_override("preset=fast")};
  const Case c = read_case(file, fast);
  EXPECT_EQ(c.time.step, StepRule::stable);
  EXPECT_EQ(c.contact.geometry, dem::ContactGeometry::sphere);
  const std::vector<Override> both = {parse_override("Time/safety=0.3"),
                                      parse_override("preset=fast")};
  EXPECT_EQ(read_case(file, both).time.safety, 0.3);
  const std::vector<Override> none = {parse_override("preset=slow")};
  try
  {
    read_case(file, none);
    FAIL();
  }
  catch (const InputError &error)
  {
    EXPECT_STREQ(error.what(),
                 "--set preset=slow: must be one of article, fast, "
                 "reference, standard");
  }
}

TEST(ParseOverride, SplitsAtTheFirstSigns)
{
  const Override o = parse_override("Specimen/gradation=a/b=c.csv");
  EXPECT_EQ(o.section, "Specimen");
  EXPECT_EQ(o.key, "gradation");
  EXPECT_EQ(o.value, "a/b=c.csv");
  EXPECT_THROW(parse_override("side=3"), InputError);
  EXPECT_THROW(parse_override("Specimen/side"), InputError);
  EXPECT_THROW(parse_override("/side=3"), InputError);
}
} // namespace
