#include "errors.h"
#include "study/after_cycles.h"
#include "study/page_tables.h"
#include "study_file.h"

#include <cmath>

namespace
{
using namespace spall;

/// A run of nine cycles, of which 3 to 6 were jumped over.
fs::path write_run(const fs::path &folder)
{
  fs::create_directories(folder);
  std::ofstream(folder / "cycles.csv")
      << "cycle_1,laa_percent,coordination_number_1,roundness_1,"
         "mean_contact_force_N,n_events_1\n"
         "1,0.1,5,0.5,10,7\n"
         "2,0.2,5.5,0.5,8,1\n"
         "6,0.6,4.5,0.4,9,40\n"
         "9,0.9,6,0.3,6,2\n";
  std::ofstream(folder / "summary.json")
      << "{\"is_complete\": false, \"coordination_start_1\": 4,"
         " \"roundness_start_1\": 0.6, \"mean_contact_force_start_N\": 5}";
  return folder;
}

std::vector<double> after(int cycle, const fs::path &run)
{
  return outcomes_after(cycle,
                        {"laa_percent", "coordination_end_1",
                         "coordination_change_1", "roundness_change_1",
                         "mean_contact_force_change_1", "n_events",
                         "processor_s"},
                        run);
}

TEST(StudyAfterCycles, OutcomesAreThoseOfTheRow)
{
  const fs::path run = write_run(support::test_folder() / "run");
  const std::vector<double> values = after(2, run);
  EXPECT_DOUBLE_EQ(values[0], 0.2);
  EXPECT_DOUBLE_EQ(values[1], 5.5);
  EXPECT_DOUBLE_EQ(values[2], 1.5);
  EXPECT_DOUBLE_EQ(values[3], -0.1);
  EXPECT_DOUBLE_EQ(values[4], 0.6);
  EXPECT_DOUBLE_EQ(values[5], 8.);
  EXPECT_TRUE(std::isnan(values[6])); // of the whole run alone
  EXPECT_DOUBLE_EQ(after(1, run)[5], 7.);
  EXPECT_DOUBLE_EQ(after(9, run)[5], 50.);
}

TEST(StudyAfterCycles, JumpedCyclesLieBetweenRows)
{
  const fs::path run = write_run(support::test_folder() / "run");
  const std::vector<double> values = after(3, run);
  EXPECT_DOUBLE_EQ(values[0], 0.3);
  EXPECT_DOUBLE_EQ(values[1], 5.25);
  EXPECT_DOUBLE_EQ(values[5], 18.);
}

TEST(StudyAfterCycles, RunsThatAreShorterGiveNone)
{
  const fs::path folder = support::test_folder(),
                 run = write_run(folder / "run");
  EXPECT_TRUE(std::isnan(after(10, run)[0]));
  EXPECT_TRUE(std::isnan(after(1, folder / "none")[0]));
  std::ofstream(run / "cycles.csv") << "";
  EXPECT_TRUE(std::isnan(after(1, run)[0]));
}

// More abrasion at the higher density after two cycles, less after nine; at the
// end no difference.
TEST_F(StudyFile, StatementsAreTestedAfterCycles)
{
  const auto read = [&](const std::string &cycles)
  {
    return read_study(write(
        "s.prm", "subsection Study\n  set case = c.prm\n"
                 "  set outcomes = laa_percent\n  set seeds = 1, 2\n"
                 "  set judged_by = seeds\n  set after_cycles = " +
                     cycles +
                     "\nend\nsubsection Sweep\n"
                     "  set Particle/density = 2000, 3000\nend\n"
                     "subsection Expect\n"
                     "  set up = laa_percent rises with Particle/density: as "
                     "X\nend\n"));
  };
  for (const char *wrong : {"0", "2.5", "9, 2", "2, 2", "2,,9"})
    EXPECT_THROW(read(wrong), InputError) << wrong;
  const Study study = read("2, 9");
  const std::vector<StudyPoint> points = points_of(study);
  std::vector<PointResult> results;
  for (const StudyPoint &point : points)
  {
    const double seed = std::stod(point.seed),
                 change = point.values[0] == "3000" ? 1. + 1e-3 * seed : 0.;
    results.push_back({true, "", {seed}, {{seed + change}, {seed - change}}});
  }
  const std::string text = study_markdown({study, points, results}, "s");
  EXPECT_NE(text.find("| name | reported | holds after 2 | holds after 9 | "
                      "holds |"),
            std::string::npos)
      << text;
  EXPECT_NE(text.find("| up | as X | yes | no | unchanged |"),
            std::string::npos)
      << text;
}
} // namespace
