#include "case/file.h"
#include "errors.h"
#include "report/run_data.h"
#include "study_file.h"

#include <algorithm>

using namespace spall;

namespace
{
bool has_line(const std::vector<std::string> &lines, const std::string &ending)
{
  return std::ranges::any_of(lines, [&ending](const std::string &line)
                             { return line.ends_with(ending); });
}

std::string refusal_of(const std::string &file)
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
} // namespace

TEST_F(StudyFile, CaseWithOldNamesIsReadAndEachIsReported)
{
  const std::string file =
      write("old.prm",
            "subsection Case\n  set kind = los_angeles\nend\n"
            "subsection Stone\n  set density = 2600\nend\n"
            "subsection Drum\n  set shelf_height = 0.08\nend\n"
            "subsection Contact\n  set geometry = ball\n"
            "  set wall_geometry = sphere\n  set search_margin = 1e-3\nend\n"
            "subsection Breakage\n  set min_ball_radius = 3e-3\nend\n");
  const Override set = parse_override("Stone/friction=0.3");
  const Case c = read_case(file, std::span(&set, 1));
  EXPECT_EQ(c.particle.density, 2600.);
  EXPECT_EQ(c.particle.friction, 0.3);
  EXPECT_EQ(c.drum.lifter_height, 0.08);
  EXPECT_EQ(c.contact.geometry, dem::ContactGeometry::sphere);
  EXPECT_EQ(c.contact.skin, 1e-3);
  EXPECT_EQ(c.breakage.min_equivalent_radius, 3e-3);
  EXPECT_EQ(c.deprecated.size(), 6u); // once each, also of files read twice
  for (const std::string line :
       {"old.prm:5: deprecated key Stone/density: use Particle/density",
        "old.prm:8: deprecated key Drum/shelf_height: use Drum/lifter_height",
        "old.prm:11: deprecated value Contact/geometry = ball: use sphere",
        "old.prm:13: deprecated key Contact/search_margin: use Contact/skin",
        "--set: deprecated key Stone/friction: use Particle/friction"})
    EXPECT_TRUE(has_line(c.deprecated, line)) << line;
}

TEST_F(StudyFile, MisspeltKeyOfAnOldSectionIsRefused)
{
  const std::string file =
      write("bad.prm", "subsection Stone\n  set densty = 2600\nend\n");
  EXPECT_NE(refusal_of(file).find("did you mean density?"), std::string::npos)
      << refusal_of(file);
}

TEST_F(StudyFile, KeysOfOneKindInASharedSectionAreRefusedInOthers)
{
  const std::string file =
      write("bad.prm", "subsection Case\n  set kind = los_angeles\nend\n"
                       "subsection Particle\n  set diameter = 0.02\nend\n");
  EXPECT_NE(refusal_of(file).find("has no key diameter in section Particle"),
            std::string::npos)
      << refusal_of(file);
}

TEST_F(StudyFile, OldAndPresentNameOfOneKeyAreRefused)
{
  const std::string file =
      write("bad.prm", "subsection Stone\n  set density = 2600\nend\n"
                       "subsection Particle\n  set density = 2500\nend\n");
  EXPECT_NE(refusal_of(file).find("bad.prm:5: Particle/density = 2500: "
                                  "Particle/density is set twice"),
            std::string::npos)
      << refusal_of(file);
}

TEST_F(StudyFile, OldNamesOfSweepsAndExpectationsAreReplaced)
{
  const Study s = read_study(write(
      "old.prm", "subsection Study\n  set case = c.prm\n"
                 "  set outcomes = n_events\nend\n"
                 "subsection Sweep\n  set Stone/density = 2500, 2600\n"
                 "  set Contact/wall_geometry = ball, radial\nend\n"
                 "subsection Expect\n"
                 "  set heavier = n_events rises with Stone/density\nend\n"));
  ASSERT_EQ(s.keys.size(), 2u);
  EXPECT_EQ(s.keys[0].name(), "Particle/density");
  EXPECT_EQ(s.keys[1].values.front(), "sphere");
  EXPECT_EQ(s.expectations.at(0).key, "Particle/density");
  EXPECT_TRUE(has_line(s.deprecated,
                       "deprecated key Stone/density: use Particle/density"));
}

TEST_F(StudyFile, TablesWithOldColumnsAreRead)
{
  const Table table = read_table(
      write("history.csv", "time_s,stone_velocity_peak_m_per_s,shape_work_J\n"
                           "0,1,2\n"));
  ASSERT_NE(table.find("particle_velocity_peak_m_per_s"), nullptr);
  ASSERT_NE(table.find("non_conservative_work_J"), nullptr);
  EXPECT_EQ((*table.find("particle_velocity_peak_m_per_s"))[0], 1.);
}
