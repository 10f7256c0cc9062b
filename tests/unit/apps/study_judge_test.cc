#include "errors.h"
#include "study/differences.h"
#include "study/judge.h"
#include "study/page_tables.h"
#include "study_file.h"

namespace
{
using namespace spall;

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
  for (const char *relation : {"rises", "falls", "stays", "changes"})
    EXPECT_EQ(judge_means(levels({1.}), relation).ruling, Ruling::not_resolved);
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
                       "  set Particle/density = 2000, 3000\n"
                       "  set Particle/friction = 0.3, 0.6\nend\n"
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
  make("  set up = n_events rises with Particle/density where Variants=a\n"
       "  set down = n_events falls with Particle/density where Variants=b: as "
       "X\n"
       "  set no = n_events rises with Particle/density where Variants=b\n"
       "  set plus = n_events is_positive with Particle/density\n"
       "  set more = n_events answers_more with Particle/density than "
       "Particle/friction\n",
       1., -1., 0.1);
  EXPECT_EQ(points.size(), 2u * 4u * 3u);
  EXPECT_EQ(study.expectations[1].reported, "as X");
  EXPECT_EQ(ruling(0), Ruling::holds);
  EXPECT_EQ(ruling(1), Ruling::holds);
  EXPECT_EQ(ruling(2), Ruling::does_not);
  EXPECT_EQ(ruling(3), Ruling::not_resolved); // 100, 200, 300
  EXPECT_EQ(ruling(4), Ruling::not_resolved); // a and b cancel
  const SeedValues ends =
      paired_differences({study, points, results}, Cut(0), 0, "a", "b");
  ASSERT_EQ(ends.size(), 3u);
  // Density over all rows of a variant: 2, 3 and twice 2.75.
  EXPECT_NEAR(ends.at("2"), -2. * (2. + 3. + 2. * 2.75) / 4., 1e-12);
}

// A seed that one of the keys lacks counts for neither.
TEST_F(SeededStudy, KeysAreComparedOverTheSeedsOfBoth)
{
  make("  set more = n_events answers_more with Particle/density than "
       "Particle/friction where Variants=a\n",
       1., -1., 0.1);
  EXPECT_EQ(ruling(0), Ruling::holds); // 1 against 0
  for (std::size_t p = 0; p < points.size(); ++p)
    if (points[p].seed == "1" && points[p].values[2] == "0.6")
      results[p].is_done = false;
  EXPECT_EQ(ruling(0), Ruling::holds);
}

// Where seeds of the first value are missing, the others still resolve what
// they differ by.
TEST_F(SeededStudy, ValueWithMostCasesIsTheReference)
{
  make("", 1., 1., 0.1);
  const StudyData all{study, points, results};
  EXPECT_EQ(reference_value(all, 1), "2000");
  EXPECT_EQ(reference_words(all, 1), "the first value");
  for (std::size_t p = 0; p < points.size(); ++p)
    if (points[p].seed == "1" && points[p].values[1] == "2000")
      results[p].is_done = false;
  EXPECT_EQ(reference_value(all, 1), "3000");
  EXPECT_EQ(reference_words(all, 1), "the value 3000");
  for (const Difference &d : differences_of(all, 1))
  {
    EXPECT_EQ(d.is_reference, d.level.value == "3000");
    EXPECT_NEAR(d.reference, 203., 1e-12);
    if (!d.is_reference)
    {
      EXPECT_NEAR(d.over_seeds.mean, -1.05, 1e-12);
    }
  }
  const StudyData none{study, {}, {}}; // no case is finished
  EXPECT_EQ(reference_value(none, 1), "");
  EXPECT_EQ(reference_words(none, 1), "the first value");
}

TEST_F(SeededStudy, WhatSeedsDifferByIsNotResolved)
{
  make("  set up = n_events rises with Particle/density where Variants=a\n"
       "  set same = n_events stays with Particle/density where Variants=a\n",
       1., -1., 1.);
  EXPECT_EQ(ruling(0), Ruling::unchanged);
  EXPECT_EQ(ruling(1), Ruling::holds); // 1 of 202
  make("  set up = n_events rises with Particle/density where Variants=a\n"
       "  set same = n_events stays with Particle/density where Variants=a\n",
       1., -1., 5.); // 1 +- 12
  EXPECT_EQ(ruling(0), Ruling::not_resolved);
  EXPECT_EQ(ruling(1), Ruling::not_resolved);
}

// 2 (seed k: 2 +- 0.02) from 200 on: by 0.01.
TEST_F(SeededStudy, SharesAreThoseOfTheFirstValue)
{
  make(
      "  set in = n_events rises with Particle/density by 0.0045..0.0055 where "
      "Variants=a\n"
      "  set below = n_events rises with Particle/density by 0.001..0.0049 "
      "where "
      "Variants=a\n"
      "  set above = n_events rises with Particle/density by 0.0051..1 where "
      "Variants=a\n"
      "  set down = n_events falls with Particle/density by 0.0045..0.0055 "
      "where "
      "Variants=b\n"
      "  set other = n_events answers_more with Particle/density than "
      "Variants=b where Variants=a\n"
      "  set less = n_events answers_more with Particle/density than "
      "Variants=a where Variants=b\n"
      "  set near = n_events stays with Particle/density by 0.004..0.006 where "
      "Variants=a\n"
      "  set far = n_events stays with Particle/density by -0.004..0.004 where "
      "Variants=a\n",
      1.01, -1., 0.001);
  // From 202.02 up by 1.01: 0.0050; from 198 down by 1: 0.00505.
  EXPECT_EQ(ruling(0), Ruling::holds);
  EXPECT_EQ(ruling(1), Ruling::does_not);
  EXPECT_EQ(ruling(2), Ruling::does_not);
  EXPECT_EQ(ruling(3), Ruling::holds);
  EXPECT_EQ(ruling(4), Ruling::holds);
  EXPECT_EQ(ruling(5), Ruling::does_not);
  EXPECT_EQ(ruling(6), Ruling::holds);
  EXPECT_EQ(ruling(7), Ruling::does_not);
  EXPECT_EQ(in_words(study.expectations[0]),
            "n_events rises with Particle/density by 0.450 to 0.550 % where "
            "Variants = a");
}

// Slopes of 1 and -1 over the density: apart, not their mean of zero.
TEST_F(SeededStudy, ChartsAndTablesTellVariantsApart)
{
  make("", 1., -1., 0.);
  const StudyData data{study, points, results};
  EXPECT_FALSE(series_of(data, 0)[0].where_key); // of the variants themselves
  const std::vector<Cut> series = series_of(data, 1);
  ASSERT_EQ(series.size(), 2u);
  EXPECT_EQ(series[1].where_value, "b");
  EXPECT_DOUBLE_EQ(levels_of(data, series[0], 0)[1].mean(), 203.);
  EXPECT_DOUBLE_EQ(levels_of(data, series[1], 0)[1].mean(), 197.);
  const std::string text = page_files(data, "w").back().text;
  EXPECT_NE(text.find("Variants = a,n_events,203,100,1,0,"), std::string::npos)
      << text;
  EXPECT_NE(text.find("Variants = b,n_events,197,100,-1,0,"),
            std::string::npos);
  EXPECT_NE(study_markdown(data, "w").find("| n_events | a | 202.0 ± 100 | "),
            std::string::npos)
      << study_markdown(data, "w");
  const std::string page = study_page(data, folder, {});
  const std::size_t chart = page.find("id=\"n_events_Particle_density\"");
  ASSERT_NE(chart, std::string::npos);
  EXPECT_NE(page.find(">a</text>", chart), std::string::npos);
}

// A value that one variant has not: the others stay below their heads.
TEST_F(SeededStudy, CellsStayBelowTheirValues)
{
  make("", 1., -1., 0.);
  for (std::size_t p = points.size(); p-- > 0;)
    if (points[p].values[0] == "b" && points[p].values[1] == "2000")
    {
      points.erase(points.begin() + static_cast<std::ptrdiff_t>(p));
      results.erase(results.begin() + static_cast<std::ptrdiff_t>(p));
    }
  const std::string page = study_markdown({study, points, results}, "w");
  EXPECT_NE(page.find("| n_events | b |  | 197.0 ± 100 |"), std::string::npos)
      << page;
}

class CourseOfASweep : public StudyFile
{
protected:
  /// One outcome over friction 0.1, 0.3, 0.4 and 0.5 with three seeds, which
  /// differ by an offset and by 1 % of the values.
  Ruling ruling(const std::string &sentence, JudgedBy rule,
                const std::vector<double> &values)
  {
    Study study = read_study(
        write("c2.prm", "subsection Study\n  set case = c.prm\n"
                        "  set outcomes = n_events\n  set seeds = 1, 2, 3\n"
                        "  set combine = grid\nend\nsubsection Sweep\n"
                        "  set Particle/friction = 0.1, 0.3, 0.4, 0.5\nend\n"
                        "subsection Expect\n  set it = n_events " +
                            sentence + "\nend\n"));
    study.judged_by = rule;
    const std::vector<StudyPoint> points = points_of(study);
    std::vector<PointResult> results;
    for (std::size_t k = 0; k < points.size(); ++k)
    {
      const double seed = std::stod(points[k].seed) - 2.;
      results.push_back(
          {true, "", {values[k / 3] * (1. + 0.01 * seed) + 10. * seed}});
    }
    return judge({study, points, results}, study.expectations[0]).ruling;
  }
};

TEST_F(CourseOfASweep, IsSteeperLevelOrTurnsFromAValue)
{
  const std::vector<double> steeper = {100., 120., 200., 280.},
                            level = {100., 140., 140.5, 140.2},
                            turns = {100., 140., 120., 100.},
                            straight = {100., 120., 130., 140.};
  const std::string key = "with Particle/friction ";
  for (const JudgedBy rule : {JudgedBy::means, JudgedBy::seeds})
  {
    const auto of = [&](const std::string &relation, const std::string &course,
                        const std::vector<double> &values)
    { return ruling(relation + " " + key + course, rule, values); };
    EXPECT_EQ(of("rises", "steeper_from 0.3", steeper), Ruling::holds);
    EXPECT_EQ(of("rises", "steeper_from 0.3", level), Ruling::does_not);
    EXPECT_EQ(of("rises", "level_from 0.3", level), Ruling::holds);
    EXPECT_EQ(of("rises", "level_from 0.3", steeper), Ruling::does_not);
    EXPECT_EQ(of("rises", "turns_at 0.3", turns), Ruling::holds);
    EXPECT_EQ(of("rises", "turns_at 0.3", straight), Ruling::does_not);
    EXPECT_EQ(of("falls", "turns_at 0.3", turns), Ruling::does_not);
  }
  EXPECT_EQ(
      ruling("rises " + key + "steeper_from 0.3", JudgedBy::seeds, straight),
      Ruling::not_resolved);
  // The ends of the sweep are no turning points.
  EXPECT_EQ(ruling("rises " + key + "turns_at 0.5", JudgedBy::seeds, straight),
            Ruling::not_resolved);
  EXPECT_THROW(ruling("rises " + key + "turns_at 0.35", JudgedBy::seeds, turns),
               InputError);
  EXPECT_THROW(ruling("stays " + key + "turns_at 0.3", JudgedBy::seeds, turns),
               InputError);
  EXPECT_THROW(ruling("rises " + key + "by 0.3", JudgedBy::seeds, turns),
               InputError);
  EXPECT_THROW(ruling("rises " + key + "by 0.3..0.2", JudgedBy::seeds, turns),
               InputError);
}

// Of many steps some go the other way by chance, as the second one here.
TEST_F(CourseOfASweep, SmallStepTheOtherWayDoesNotCount)
{
  const std::string rises = "rises with Particle/friction";
  for (const JudgedBy rule : {JudgedBy::means, JudgedBy::seeds})
  {
    EXPECT_EQ(ruling(rises, rule, {100., 140., 138., 200.}), Ruling::holds);
    EXPECT_EQ(ruling(rises, rule, {100., 140., 120., 200.}), Ruling::does_not);
  }
}

TEST_F(SeededStudy, BadSentencesAreRefused)
{
  EXPECT_THROW(make("  set x = n_events rises with\n", 1., 1., 0.), InputError);
  EXPECT_THROW(
      make("  set x = n_events rises with Wall/friction\n", 1., 1., 0.),
      InputError);
  EXPECT_THROW(make("  set x = n_events answers_more with Particle/density\n",
                    1., 1., 0.),
               InputError);
  EXPECT_THROW(make("  set x = n_events rises with Particle/density than "
                    "Particle/friction\n",
                    1., 1., 0.),
               InputError);
}
} // namespace
