#include "errors.h"
#include "study/measured.h"
#include "study/profiles.h"
#include "study_file.h"

#include <set>

namespace
{
using namespace spall;

// 3 x 2 values and two seeds.
TEST_F(StudyFile, GridTakesAllCombinations)
{
  const Study grid = study("grid");
  EXPECT_EQ(grid.seed_key, "Particle/seed");
  EXPECT_EQ(points_of(grid).size(), 12u);
}

// A case is where it was done, whatever its index in the sweep; what is there
// of others stays.
TEST_F(StudyFile, CasesAreFoundByWhatTheyAre)
{
  std::vector<StudyPoint> points = points_of(study("grid"));
  points.resize(3);
  const auto hold = [&](const char *name, const std::string &text, bool is_done)
  {
    fs::create_directories(folder / "out" / name);
    std::ofstream(folder / "out" / name / "case.prm") << text;
    if (is_done)
      std::ofstream(folder / "out" / name / "summary.json")
          << "{\"is_complete\": true}";
  };
  hold("run_0001", "subsection Of\n  set another = case\nend\n", true);
  hold("run_0002", points[2].resolved, false);
  hold("run_0003", "# another first line\n" + points[2].resolved, true);
  // Before there was a key: it has its default.
  std::string older = points[1].resolved;
  const std::size_t key = older.find("  set rolling_friction");
  older.erase(key, older.find('\n', key) + 1 - key);
  hold("run_0004", older, false);
  find_folders(points, folder / "out");
  EXPECT_EQ(points[0].folder, "run_0005");
  EXPECT_EQ(points[1].folder, "run_0004");
  EXPECT_EQ(points[2].folder, "run_0003");
  std::vector<StudyPoint> fresh = points_of(study("grid"));
  find_folders(fresh, folder / "none");
  EXPECT_EQ(fresh[0].folder, "run_0001");
  EXPECT_EQ(fresh[11].folder, "run_0012");
}

// A value with commas stays in its column.
TEST_F(StudyFile, TableQuotesValuesWithCommas)
{
  const Study grid = study("grid");
  StudyPoint point = points_of(grid)[0];
  point.values_in_case = {"0.4 80e6, 1 50e6", "of \"one\" layer"};
  point.folder = "run_0001";
  write_study_table(grid, {point}, {{true, "", {1.5}}}, folder / "study.csv");
  std::ifstream in(folder / "study.csv");
  std::string header, row;
  std::getline(in, header);
  std::getline(in, row);
  EXPECT_EQ(row, "run_0001,1,\"0.4 80e6, 1 50e6\",\"of \"\"one\"\" layer\"," +
                     point.seed + ",1.5");
}

// In a grid of two keys each is seen at every value of the other.
TEST_F(StudyFile, GridIsSeenByTheOtherKey)
{
  const Study grid = study("grid");
  const std::vector<StudyPoint> points = points_of(grid);
  std::vector<PointResult> results;
  for (const StudyPoint &point : points)
    results.push_back(
        {true, "", {std::stod(point.values[0]) * std::stod(point.values[1])}});
  const StudyData data{grid, points, results};
  const std::vector<Cut> series = series_of(data, 0);
  ASSERT_EQ(series.size(), 2u);
  EXPECT_EQ(*series[1].where_key, 1u);
  EXPECT_DOUBLE_EQ(levels_of(data, series[1], 0)[2].mean(), 3000. * 2e-6);
  EXPECT_EQ(series_of(data, 1).size(), 3u);
}

// Each variant sets its keys together; the other sweep runs as it is given.
TEST_F(StudyFile, VariantsSetKeysTogether)
{
  const std::string head = "subsection Study\n  set case = c.prm\n"
                           "  set outcomes = n_events\nend\n"
                           "subsection Variants\n";
  const Study two = read_study(write(
      "v.prm", head + "  set light = Particle/density=2000; Press/speed=0.01\n"
                      "  set heavy = Particle/density=3000\nend\n"
                      "subsection Sweep\n  set Time/fixed_step = 1e-6\nend\n"));
  const std::vector<StudyPoint> points = points_of(two);
  ASSERT_EQ(points.size(), 3u);
  EXPECT_EQ(points[0].values[0], "light");
  EXPECT_NE(points[0].resolved.find("speed = 0.01"), std::string::npos);
  EXPECT_NE(points[1].resolved.find("density = 3000"), std::string::npos);
  EXPECT_EQ(points[2].values[0], "as_given");
  EXPECT_THROW(read_study(write("w.prm", head + "  set bad = density\nend\n")),
               InputError);
}

// The base case (2750 kg/m^3, 1 us) is a point of both sweeps and runs once.
TEST_F(StudyFile, EachSharesTheBaseCase)
{
  const Study each = study("each");
  const std::vector<StudyPoint> points = points_of(each);
  EXPECT_EQ(points.size(), 8u);
  std::size_t n_shared = 0;
  for (const StudyPoint &point : points)
    n_shared += point.sweeps.size() == 2;
  EXPECT_EQ(n_shared, 2u); // one for each seed
  std::vector<PointResult> results;
  for (std::size_t k = 0; k < points.size(); ++k)
    results.push_back(
        {k != 0, "", {std::stod(points[k].values[0]) + 2. * (k % 2)}});
  const std::vector<Level> levels =
      levels_of({each, points, results}, Cut(0), 0);
  ASSERT_EQ(levels.size(), 3u);
  EXPECT_EQ(levels[0].samples.size(), 1u); // the first case failed
  EXPECT_EQ(levels[2].value, "3000");
  EXPECT_DOUBLE_EQ(levels[2].mean(), 3001.);
  EXPECT_DOUBLE_EQ(levels[2].deviation(), std::sqrt(2.));
}

// What is compared stands side by side: all cases of a seed, or of as many
// seeds as run at a time, before the next.
TEST_F(StudyFile, CasesOfASeedRunTogether)
{
  const std::vector<StudyPoint> points = points_of(study("each"));
  std::vector<std::string> seeds;
  for (const std::size_t k : running_order(points, 1))
    seeds.push_back(points[k].seed);
  EXPECT_EQ(seeds,
            (std::vector<std::string>{"1", "1", "1", "1", "2", "2", "2", "2"}));
  std::size_t index = 0;
  for (const std::size_t k : running_order(points, 2))
    EXPECT_EQ(k, index++);
}

// Every case is in one part, and a part has cases of as few seeds as it can.
TEST_F(StudyFile, PartsShareTheCases)
{
  const std::vector<StudyPoint> points = points_of(study("each"));
  const auto seeds_of = [&](std::size_t number, std::size_t n_parts)
  {
    std::string seeds;
    for (const StudyPoint &point : part_of(points, {number, n_parts}))
      seeds += point.seed;
    return seeds;
  };
  EXPECT_EQ(seeds_of(1, 1), "11112222");
  EXPECT_EQ(seeds_of(1, 3) + "," + seeds_of(2, 3) + "," + seeds_of(3, 3),
            "11,112,222");
  std::set<std::string> folders;
  std::size_t n = 0;
  for (std::size_t number = 1; number <= 11; ++number)
    for (const StudyPoint &point : part_of(points, {number, 11}))
    {
      folders.insert(point.folder);
      ++n;
    }
  EXPECT_EQ(n, points.size());
  EXPECT_EQ(folders.size(), points.size());
}

// Points of the file at the value of the key, the other key as in the base.
TEST_F(StudyFile, MeasuredPointsAreThoseOfTheValue)
{
  write("m.csv", "Particle/density,Time/fixed_step,time_s,force_N\n"
                 "2000,1e-6,0.1,5\n2000,1e-6,0.2,6\n2000,2e-6,0.1,7\n"
                 "2750,1e-6,0.1,8\n");
  const std::string text =
      "subsection Study\n  set case = c.prm\n  set outcomes = n_events\n"
      "  set curve = time_s, force_N\n  set measured = m.csv\nend\n"
      "subsection Base\n  set Time/fixed_step = 1e-6\nend\n"
      "subsection Sweep\n  set Particle/density = 2000, 3000\n"
      "  set Time/fixed_step = 2e-6\nend\n";
  const Study study = read_study(write("m.prm", text));
  const std::vector<StudyPoint> points = points_of(study);
  const std::vector<PointResult> results(points.size());
  const auto at = [&](const std::string &value) {
    return measured_points({study, points, results}, Cut(0), value);
  };
  EXPECT_EQ(at("2000").x, (std::vector<double>{0.1, 0.2}));
  EXPECT_EQ(at("2000").y, (std::vector<double>{5., 6.}));
  EXPECT_EQ(at("2750").y, (std::vector<double>{8.}));
  EXPECT_TRUE(at("3000").x.empty());
  // Keys that are not swept count as the case has them.
  write("m.csv", "Particle/density,Particle/friction,time_s,force_N\n"
                 "2000,0.5,0.1,5\n2000,0.7,0.1,6\n");
  EXPECT_EQ(at("2000").y, (std::vector<double>{5.}));
  write("m.csv", "Particle/friction,time_s,force_N\n0.5,0.1,5\n");
  EXPECT_THROW(read_study(write("m.prm", text)), InputError);
}

// A variant that sets a swept key keeps its value, and is no other case.
// Two cases of a value, row by row: the first and the last are of one alone.
TEST_F(StudyFile, ProfilesAreMeansOfTheCases)
{
  const std::string head = "subsection Study\n  set case = c.prm\n"
                           "  set outcomes = n_events\n  set seeds = 1, 2\n"
                           "  set profiles = ";
  const std::string tail = "\nend\nsubsection Sweep\n"
                           "  set Particle/density = 2000\nend\n";
  const Study given = read_study(
      write("p.prm", head + "edge.csv: distance_m, porosity_1" + tail));
  ASSERT_EQ(given.profiles.size(), 1u);
  const std::vector<StudyPoint> points = points_of(given);
  ASSERT_EQ(points.size(), 2u);
  for (const StudyPoint &point : points)
    fs::create_directories(folder / point.folder);
  write(points[0].folder + "/edge.csv",
        "distance_m,porosity_1\n0.1,0.5\n0.2,0.4\n");
  write(points[1].folder + "/edge.csv",
        "distance_m,porosity_1\n0.1,nan\n0.4,0.2\n0.6,0.1\n");
  const std::vector<PointResult> results(2, {true, "", {1.}});
  const Chart chart =
      profile_chart({given, points, results}, 0, given.profiles[0], folder);
  ASSERT_EQ(chart.curves.size(), 2u);
  const Curve &bars = chart.curves[0], &means = chart.curves[1];
  EXPECT_EQ(means.name, "2000 kg/m^3");
  ASSERT_EQ(means.x.size(), 1u);
  EXPECT_NEAR(means.x[0], 0.3, 1e-15);
  EXPECT_NEAR(means.y[0], 0.3, 1e-15);
  EXPECT_NEAR(bars.y[1] - bars.y[0], 2. * std::sqrt(0.02), 1e-15);
  for (const char *wrong : {"edge.csv", "edge.csv: distance_m", ": a, b"})
    EXPECT_THROW(read_study(write("q.prm", head + wrong + tail)), InputError);
}

TEST_F(StudyFile, VariantsMaySetWhatIsSwept)
{
  const Study map = read_study(
      write("v.prm", "subsection Study\n  set case = c.prm\n"
                     "  set outcomes = n_events\nend\n"
                     "subsection Variants\n"
                     "  set plain = Particle/friction=0.3\n"
                     "  set dense = Particle/density=3000\nend\n"
                     "subsection Sweep\n  set Particle/density = 2000\nend\n"));
  const std::vector<StudyPoint> points = points_of(map);
  ASSERT_EQ(points.size(), 3u);
  EXPECT_EQ(points[1].values, (std::vector<std::string>{"dense", "2750"}));
  EXPECT_EQ(points[1].values_in_case,
            (std::vector<std::string>{"dense", "3000"}));
  EXPECT_NE(points[1].resolved.find("density = 3000"), std::string::npos);
  EXPECT_EQ(points[2].values_in_case[1], "2000");
}
} // namespace
