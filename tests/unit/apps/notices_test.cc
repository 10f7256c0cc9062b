#include "case/file.h"
#include "errors.h"
#include "study_file.h"

#include <algorithm>

using namespace spall;

namespace
{
using Lines = std::vector<std::string>;
} // namespace

TEST_F(StudyFile, ValuesInOtherUnitsAreNoticed)
{
  const std::string file = write(
      "units.prm",
      "subsection Case\n  set kind = scene\nend\n"
      "subsection Particle\n  set density = 2.7\n  set shear_modulus = 5e8\n"
      "end\n"
      "subsection Box\n  set lower = 0, 0, -0.1\n  set upper = 300, 200, 1\n"
      "end\n"
      "subsection Scene\n  set particles = p.csv\nend\n");
  write("p.csv", "x,y,z,radius\n0,0,0,0.01\n");
  EXPECT_EQ(read_case(file, {}).notices,
            (Lines{file + ":10: Box/upper = 300, 200, 1: unusual: most are "
                          "-30 to 30 m, so check the unit",
                   file + ":5: Particle/density = 2.7: unusual: most are "
                          "100 to 25000 kg/m^3, so check the unit"}));
}

TEST_F(StudyFile, UsualValuesAndZeroAreNotNoticed)
{
  const std::string file =
      write("usual.prm", "subsection Case\n  set kind = single_particle\nend\n"
                         "subsection Particle\n  set density = 2700\nend\n");
  EXPECT_EQ(read_case(file, {}).notices, Lines{});
  Parameter parameter;
  double value = 0.;
  parameter.value = &value;
  parameter.usual = between(500., 1e9);
  EXPECT_FALSE(is_unusual(parameter));
  value = 499.;
  EXPECT_TRUE(is_unusual(parameter));
  value = 500.;
  EXPECT_FALSE(is_unusual(parameter));
  EXPECT_EQ(usual(parameter), "500 to 1e+09");
}

TEST_F(StudyFile, BreakageThatCannotBreakIsNoticed)
{
  const std::string file =
      write("idle.prm", "subsection Case\n  set kind = single_particle\nend\n"
                        "subsection Contact\n  set geometry = sphere\n"
                        "  set wall_geometry = sphere\nend\n"
                        "subsection Breakage\n  set is_active = true\nend\n");
  EXPECT_EQ(read_case(file, {}).notices,
            Lines{file + ":9: Breakage/is_active = true: nothing breaks: "
                         "Contact/geometry = sphere needs Breakage/contacts = "
                         "all"});
  const Override all = parse_override("Breakage/contacts=all");
  EXPECT_EQ(read_case(file, std::span(&all, 1)).notices, Lines{});
}

TEST_F(StudyFile, ChangesSinceAPrintedCaseAreNamed)
{
  const std::string file =
      write("c.prm", "subsection Case\n  set kind = single_particle\nend\n");
  const std::string printed =
      write("printed.prm", resolved_case(read_case(file, {})));
  EXPECT_EQ(changes_since(printed, read_case(file, {})), Lines{});
  const Override rows = parse_override("Particle/density=2000");
  EXPECT_EQ(changes_since(printed, read_case(file, std::span(&rows, 1))),
            Lines{"Particle/density = 2000, was 2750"});
}

TEST_F(StudyFile, SettingsOfAStudyAreNoticedWithTheirLine)
{
  write("c.prm", "subsection Case\n  set kind = single_particle\nend\n");
  const std::string file =
      write("s.prm", "subsection Study\n  set case = c.prm\n"
                     "  set outcomes = n_events\nend\n"
                     "subsection Base\n  set Particle/density = 2.7\nend\n"
                     "subsection Sweep\n"
                     "  set Particle/shear_modulus = 30, 5e8\nend\n");
  const Study study = read_study(file);
  EXPECT_EQ(
      notices_of(points_of(study)),
      (Lines{file + ":6: Base: Particle/density = 2.7: unusual: most "
                    "are 100 to 25000 kg/m^3, so check the unit",
             file + ":9: Sweep: Particle/shear_modulus = 30: unusual: most "
                    "are 10000 to 1e+13 Pa, so check the unit"}));
}

TEST_F(StudyFile, ValuesInOtherUnitsWithinTextsAndFilesAreNoticed)
{
  const std::string ground = write(
      "ground.prm", "subsection Case\n  set kind = subgrade\nend\n"
                    "subsection Subgrade\n"
                    "  set layers = 0.3 60e6 0.3 1900, 0.9 30 0.35 1.8\nend\n"
                    "subsection Coupling\n  set exchange = one_pass\nend\n");
  const std::string second = ground + ":5: Subgrade/layers: ";
  EXPECT_EQ(
      read_case(ground, {}).notices,
      (Lines{second + "Young's modulus of layer 2 = 30: unusual: most are "
                      "10000 to 1e+13 Pa, so check the unit",
             second + "density of layer 2 = 1.8: unusual: most are 100 to "
                      "25000 kg/m^3, so check the unit"}));
  write("path.csv", "name,axial_stress_Pa,duration_s\nload,200,1\n"
                    "unload,50e3,1\n");
  const std::string path =
      write("path.prm", "subsection Boundary\n  set lateral = rigid\nend\n"
                        "subsection Loading\n  set form = path\n"
                        "  set path = path.csv\nend\n");
  EXPECT_EQ(read_case(path, {}).notices,
            (Lines{path + ":6: Loading/path: axial stress of stage 1 = 200: "
                          "unusual: most are 500 to 1e+09 Pa, so check the "
                          "unit"}));
}

TEST_F(StudyFile, ReportsAfterTheEndAreNoticed)
{
  const std::string text = "subsection Case\n  set kind = "
                           "vibratory_compaction\nend\nsubsection Vibration\n"
                           "  set duration = 10\n";
  EXPECT_EQ(read_case(write("end.prm", text + "end\n"), {}).notices, Lines{});
  const std::string file =
      write("late.prm", text + "  set reports = 5 50\nend\n");
  EXPECT_EQ(read_case(file, {}).notices,
            Lines{file + ":6: Vibration/reports = 5 50: there is none after "
                         "Vibration/duration = 10 s"});
}
