#include "errors.h"
#include "study/judge.h"
#include "study/prices.h"
#include "study/tables.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

namespace
{
using namespace spall;
namespace fs = std::filesystem;

class StudyFile : public testing::Test
{
protected:
  void SetUp() override
  {
    folder = fs::path(testing::TempDir()) /
             testing::UnitTest::GetInstance()->current_test_info()->name();
    fs::create_directories(folder);
    write("c.prm", "subsection Case\n  set kind = single_particle\nend\n"
                   "subsection Particle\n  set shape =\nend\n");
  }
  void TearDown() override { fs::remove_all(folder); }

  std::string write(const std::string &name, const std::string &text)
  {
    std::ofstream(folder / name) << text;
    return (folder / name).string();
  }

  Study study(const std::string &combine)
  {
    return read_study(
        write("s.prm", "subsection Study\n  set case = c.prm\n"
                       "  set outcomes = n_events\n  set seeds = 1, 2\n"
                       "  set combine = " +
                           combine +
                           "\nend\nsubsection Sweep\n"
                           "  set Stone/density = 2000, 2750, 3000\n"
                           "  set Time/fixed_step = 1e-6, 2e-6\nend\n"));
  }

  fs::path folder;
};

// 3 x 2 values and two seeds.
TEST_F(StudyFile, GridTakesAllCombinations)
{
  const Study grid = study("grid");
  EXPECT_EQ(grid.seed_key, "Particle/seed");
  EXPECT_EQ(points_of(grid).size(), 12u);
}

// A case is where it was done, whatever its place in the sweep; what is there
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
  hold("run_0004", points[1].resolved, false);
  find_folders(points, folder / "out");
  EXPECT_EQ(points[0].folder, "run_0005");
  EXPECT_EQ(points[1].folder, "run_0004");
  EXPECT_EQ(points[2].folder, "run_0003");
  std::vector<StudyPoint> fresh = points_of(study("grid"));
  find_folders(fresh, folder / "none");
  EXPECT_EQ(fresh[0].folder, "run_0001");
  EXPECT_EQ(fresh[11].folder, "run_0012");
}

// Each variant sets its keys together; the other sweep runs as it is given.
TEST_F(StudyFile, VariantsSetKeysTogether)
{
  const std::string head = "subsection Study\n  set case = c.prm\n"
                           "  set outcomes = n_events\nend\n"
                           "subsection Variants\n";
  const Study two = read_study(write(
      "v.prm", head + "  set light = Stone/density=2000; Press/speed=0.01\n"
                      "  set heavy = Stone/density=3000\nend\n"
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

TEST(StudyLevels, JudgeTellsTheRelations)
{
  const auto levels = [](const std::vector<double> &means)
  {
    std::vector<Level> all;
    for (const double mean : means)
      all.push_back({"", static_cast<double>(all.size()), {mean}});
    return all;
  };
  const auto is_shown =
      [&](const std::vector<double> &means, const std::string &relation)
  { return judge_means(levels(means), relation).ruling == Ruling::holds; };
  EXPECT_TRUE(is_shown({1., 2., 3.}, "rises"));
  EXPECT_TRUE(is_shown({1., 1.99, 1.98, 3.}, "rises")); // within 5 %
  EXPECT_FALSE(is_shown({1., 3., 2.}, "rises"));
  EXPECT_FALSE(is_shown({2., 2.01}, "rises"));
  EXPECT_TRUE(is_shown({3., 2., 1.}, "falls"));
  EXPECT_FALSE(is_shown({1., 2., 3.}, "falls"));
  EXPECT_TRUE(is_shown({2., 2.05}, "stays"));
  EXPECT_FALSE(is_shown({2., 2.2}, "stays"));
  EXPECT_TRUE(is_shown({2., 2.2}, "changes"));
  EXPECT_TRUE(is_shown({2., 2.01, 5.}, "settles_low"));
  EXPECT_FALSE(is_shown({2., 2.01, 5.}, "settles_high"));
  EXPECT_TRUE(is_shown({5., 2.01, 2.}, "settles_high"));
  EXPECT_FALSE(is_shown({1.}, "rises"));
  std::vector<Level> missing = levels({1., 2.});
  missing[0].samples.clear();
  EXPECT_EQ(judge_means(missing, "rises").ruling, Ruling::does_not);
  EXPECT_TRUE(is_shown({1., 2.}, "is_positive"));
  EXPECT_FALSE(is_shown({-1., 2.}, "is_positive"));
}

// Student's distribution: tabulated points.
TEST(StudyEstimate, IntervalsAreStudents)
{
  EXPECT_NEAR(student_95(2), 4.303, 1e-3);
  EXPECT_NEAR(student_95(11), 2.201, 1e-3);
  EXPECT_NEAR(student_95(30), 2.042, 1e-3);
  const std::vector<double> samples = {1., 2., 3.};
  const Estimate e = estimate_of(samples);
  EXPECT_DOUBLE_EQ(e.mean, 2.);
  EXPECT_NEAR(e.half_width, 4.3027 / std::sqrt(3.), 1e-4);
  EXPECT_FALSE(e.is_resolved());
  EXPECT_FALSE(estimate_of(std::vector<double>{5.}).is_resolved());
}

class SeededStudy : public StudyFile
{
protected:
  /// Density in {2000, 3000} for two variants and three seeds; outcome
  /// (density / 1000) slope + seed, slope by the variant.
  void make(const std::string &more, double slope_a, double slope_b,
            double wobble)
  {
    study = read_study(
        write("e.prm", "subsection Study\n  set case = c.prm\n"
                       "  set outcomes = n_events\n  set seeds = 1, 2, 3\n"
                       "  set combine = each_variant\n"
                       "  set judged_by = seeds\nend\n"
                       "subsection Variants\n"
                       "  set a = Breakage/is_active=true\n"
                       "  set b = Breakage/is_active=false\nend\n"
                       "subsection Sweep\n"
                       "  set Stone/density = 2000, 3000\n"
                       "  set Stone/friction = 0.3, 0.6\nend\n"
                       "subsection Expect\n" +
                           more + "end\n"));
    points = points_of(study);
    results.clear();
    for (const StudyPoint &point : points)
    {
      const double seed = std::stod(point.seed),
                   slope = point.values[0] == "a" ? slope_a : slope_b;
      const double density = std::stod(point.values[1]) / 1000.;
      results.push_back(
          {true, "", {density * (slope + wobble * (seed - 2.)) + 100. * seed}});
    }
  }

  Ruling ruling(std::size_t k) const
  {
    return judge({study, points, results}, study.expectations[k]).ruling;
  }

  Study study;
  std::vector<StudyPoint> points;
  std::vector<PointResult> results;
};

// The seeds differ by a hundred times the effect, which pairs take out.
TEST_F(SeededStudy, PairsTakeOutWhatSeedsShare)
{
  make("  set up = n_events rises with Stone/density where Variants=a\n"
       "  set down = n_events falls with Stone/density where Variants=b: as X\n"
       "  set no = n_events rises with Stone/density where Variants=b\n"
       "  set plus = n_events is_positive with Stone/density\n"
       "  set more = n_events answers_more with Stone/density than "
       "Stone/friction\n",
       1., -1., 0.1);
  EXPECT_EQ(points.size(), 2u * 4u * 3u);
  EXPECT_EQ(study.expectations[1].reported, "as X");
  EXPECT_EQ(ruling(0), Ruling::holds);
  EXPECT_EQ(ruling(1), Ruling::holds);
  EXPECT_EQ(ruling(2), Ruling::does_not);
  EXPECT_EQ(ruling(3), Ruling::not_resolved); // 100, 200, 300
  EXPECT_EQ(ruling(4), Ruling::not_resolved); // a and b cancel
  const std::vector<double> ends =
      paired_differences({study, points, results}, Cut(0), 0, "a", "b");
  ASSERT_EQ(ends.size(), 3u);
  // Density over all rows of a variant: 2, 3 and twice 2.75.
  EXPECT_NEAR(ends[1], -2. * (2. + 3. + 2. * 2.75) / 4., 1e-12);
}

TEST_F(SeededStudy, WhatSeedsDifferByIsNotResolved)
{
  make("  set up = n_events rises with Stone/density where Variants=a\n"
       "  set same = n_events stays with Stone/density where Variants=a\n",
       1., -1., 1.);
  EXPECT_EQ(ruling(0), Ruling::not_resolved);
  EXPECT_EQ(ruling(1), Ruling::holds); // 1 of 202
}

TEST_F(SeededStudy, BadSentencesAreRefused)
{
  EXPECT_THROW(make("  set x = n_events rises with\n", 1., 1., 0.), InputError);
  EXPECT_THROW(
      make("  set x = n_events rises with Wall/friction\n", 1., 1., 0.),
      InputError);
  EXPECT_THROW(
      make("  set x = n_events answers_more with Stone/density\n", 1., 1., 0.),
      InputError);
  EXPECT_THROW(make("  set x = n_events rises with Stone/density than "
                    "Stone/friction\n",
                    1., 1., 0.),
               InputError);
}

// Reference 10, 12, 14 at cost 4; a knob that halves the cost and is off by
// 0.2 is fine, one that is off by 2 is not, one that costs more is on no front.
TEST_F(StudyFile, PricesAreAgainstTheReference)
{
  const Study map = read_study(
      write("m.prm", "subsection Study\n  set case = c.prm\n"
                     "  set outcomes = n_events, processor_s\n"
                     "  set seeds = 1, 2, 3\n  set cost = processor_s\nend\n"
                     "subsection Base\n  set Stone/friction = 0.4\nend\n"
                     "subsection Sweep\n"
                     "  set Stone/density = 2000, 2750, 3000\n"
                     "  set Time/fixed_step = 2e-7\nend\n"));
  const std::vector<StudyPoint> points = points_of(map);
  ASSERT_EQ(points.size(), 4u * 3u); // the base case once
  EXPECT_TRUE(points[0].is_base);
  EXPECT_NE(points[0].resolved.find("friction = 0.4"), std::string::npos);
  std::vector<PointResult> results;
  for (const StudyPoint &point : points)
  {
    const double base = 8. + 2. * std::stod(point.seed);
    const bool is_light = point.values[0] == "2000",
               is_heavy = point.values[0] == "3000",
               is_fine_step = point.values[1] == "2e-07";
    results.push_back({true,
                       "",
                       {base + (is_light   ? 0.2
                                : is_heavy ? 2.
                                           : 0.),
                        is_light       ? 2.
                        : is_heavy     ? 1.
                        : is_fine_step ? 8.
                                       : 4.}});
  }
  const StudyData data{map, points, results};
  EXPECT_DOUBLE_EQ(reference_spread(data)[0], 2.);
  const std::vector<PricedLevel> levels = price_levels(data);
  ASSERT_EQ(levels.size(), 3u);
  EXPECT_NEAR(levels[0].worst, 0.1, 1e-12);
  EXPECT_NEAR(levels[0].cost, 0.5, 1e-12);
  EXPECT_TRUE(levels[0].is_on_front);
  EXPECT_TRUE(levels[0].is_cheapest_fine);
  EXPECT_NEAR(levels[1].worst, 1., 1e-12);
  EXPECT_TRUE(levels[1].is_on_front);
  EXPECT_FALSE(levels[1].is_cheapest_fine);
  EXPECT_NEAR(levels[2].cost, 2., 1e-12);
  EXPECT_NE(
      study_markdown(data).find("| on the front, cheapest that is fine |"),
      std::string::npos)
      << study_markdown(data);
}

// A variant that sets a swept key keeps its value, and is no other case.
TEST_F(StudyFile, VariantsMaySetWhatIsSwept)
{
  const Study map = read_study(
      write("v.prm", "subsection Study\n  set case = c.prm\n"
                     "  set outcomes = n_events\nend\n"
                     "subsection Variants\n"
                     "  set plain = Stone/friction=0.3\n"
                     "  set dense = Stone/density=3000\nend\n"
                     "subsection Sweep\n  set Stone/density = 2000\nend\n"));
  const std::vector<StudyPoint> points = points_of(map);
  ASSERT_EQ(points.size(), 3u);
  EXPECT_EQ(points[1].values, (std::vector<std::string>{"dense", "2750"}));
  EXPECT_EQ(points[1].values_in_case,
            (std::vector<std::string>{"dense", "3000"}));
  EXPECT_NE(points[1].resolved.find("density = 3000"), std::string::npos);
  EXPECT_EQ(points[2].values_in_case[1], "2000");
}

// A value that gave no force is no choice, however near its other outcomes.
TEST_F(StudyFile, MissingOutcomesAreNoSmallErrors)
{
  const Study map = read_study(
      write("n.prm", "subsection Study\n  set case = c.prm\n"
                     "  set outcomes = peak_force_N, n_events, processor_s\n"
                     "  set seeds = 1, 2\n  set cost = processor_s\nend\n"
                     "subsection Sweep\n  set Stone/density = 2000\nend\n"));
  const std::vector<StudyPoint> points = points_of(map);
  std::vector<PointResult> results;
  for (const StudyPoint &point : points)
  {
    const double seed = std::stod(point.seed);
    results.push_back(
        {true,
         "",
         {point.is_base ? seed : std::nan(""), seed, point.is_base ? 2. : 1.}});
  }
  const std::vector<PricedLevel> levels = price_levels({map, points, results});
  ASSERT_EQ(levels.size(), 1u);
  EXPECT_TRUE(std::isinf(levels[0].worst));
  EXPECT_FALSE(levels[0].is_on_front || levels[0].is_cheapest_fine);
}
} // namespace
