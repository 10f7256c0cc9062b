#include "errors.h"
#include "study/level_costs.h"
#include "study/page_tables.h"
#include "study_file.h"

namespace
{
using namespace spall;

// Reference 10, 12, 14 at cost 4; a parameter that halves the cost and is off
// by 0.2 is fine, one that is off by 2 is not, one that costs more is on no
// front.
TEST_F(StudyFile, PricesAreAgainstTheReference)
{
  const Study map = read_study(
      write("m.prm", "subsection Study\n  set case = c.prm\n"
                     "  set outcomes = n_events, processor_s\n"
                     "  set seeds = 1, 2, 3\n  set cost = processor_s\nend\n"
                     "subsection Base\n  set Particle/friction = 0.4\nend\n"
                     "subsection Sweep\n"
                     "  set Particle/density = 2000, 2750, 3000\n"
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
  const std::vector<LevelCost> levels = level_costs(data);
  ASSERT_EQ(levels.size(), 3u);
  EXPECT_NEAR(levels[0].worst, 0.1, 1e-12);
  EXPECT_NEAR(levels[0].cost(), 0.5, 1e-12);
  EXPECT_TRUE(levels[0].is_on_front);
  EXPECT_TRUE(levels[0].is_cheapest_fine);
  EXPECT_NEAR(levels[1].worst, 1., 1e-12);
  EXPECT_TRUE(levels[1].is_on_front);
  EXPECT_FALSE(levels[1].is_cheapest_fine);
  EXPECT_NEAR(levels[2].cost(), 2., 1e-12);
  EXPECT_NE(
      study_markdown(data, "w").find("| on the front, cheapest that is fine |"),
      std::string::npos)
      << study_markdown(data, "w");
  EXPECT_NE(study_markdown(data, "w").find("[errors](w_errors.csv)"),
            std::string::npos);
}

// More seeds for the spread alone: pairs and tables of levels stay as they are.
TEST_F(StudyFile, SpreadIsOverMoreSeedsThanThePairs)
{
  const std::string text = "subsection Study\n  set case = c.prm\n"
                           "  set outcomes = n_events, processor_s\n"
                           "  set seeds = 1, 2\n  set spread_seeds = 3, 4\n"
                           "  set cost = processor_s\nend\n"
                           "subsection Sweep\n"
                           "  set Particle/density = 2000\nend\n";
  const Study map = read_study(write("w.prm", text));
  const std::vector<StudyPoint> points = points_of(map);
  ASSERT_EQ(points.size(), 2u + 2u + 2u);
  EXPECT_TRUE(points[4].is_base && points[5].is_base);
  EXPECT_TRUE(points[4].sweeps.empty());
  EXPECT_EQ(points[5].seed, "4");
  std::vector<PointResult> results;
  for (const StudyPoint &point : points) // 1, 2, 5, 8: spread of 10 / 3
    results.push_back({true,
                       "",
                       {(point.seed == "1"   ? 1.
                         : point.seed == "2" ? 2.
                         : point.seed == "3" ? 5.
                                             : 8.) +
                            (point.is_base ? 0. : 0.5),
                        point.is_base ? 4. : 2.}});
  const StudyData data{map, points, results};
  EXPECT_NEAR(reference_spread(data)[0], std::sqrt(10.), 1e-12);
  const std::vector<LevelCost> levels = level_costs(data);
  ASSERT_EQ(levels.size(), 1u);
  EXPECT_EQ(levels[0].errors[0].n, 2u);
  EXPECT_NEAR(levels[0].worst, 0.5 / std::sqrt(10.), 1e-12);
  const std::vector<PageFile> files = page_files(data, "w");
  ASSERT_EQ(files.size(), 2u);
  EXPECT_NE(files[0].text.find("\nreference,spread of 4,,,,3.16228,,\n"),
            std::string::npos)
      << files[0].text;

  const auto refusal = [&](const std::string &from, const std::string &to)
  {
    std::string other = text;
    other.replace(other.find(from), from.size(), to);
    try
    {
      read_study(write("w.prm", other));
    }
    catch (const InputError &error)
    {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_NE(refusal("  set cost = processor_s\n", "")
                .find("Study/spread_seeds needs a reference"),
            std::string::npos);
  EXPECT_NE(refusal("= 3, 4", "= 3, 2")
                .find("Study/spread_seeds: 2 is in Study/seeds already"),
            std::string::npos);
}

// Of two that are fine the default may be the dearer one by what costs differ
// from seed to seed, not by more.
TEST_F(StudyFile, DefaultsMayCostAsMuchAsTheCheapest)
{
  const Study map = read_study(
      write("e.prm",
            "subsection Study\n  set case = c.prm\n  set outcomes = n_events\n"
            "  set seeds = 1, 2, 3\n  set cost = processor_s\nend\n"
            "subsection Base\n  set Particle/density = 3000\nend\n"
            "subsection Sweep\n  set Particle/density = 2000, 2750\nend\n"));
  const std::vector<StudyPoint> points = points_of(map);
  const auto verdict = [&](double dearer, double scatter)
  {
    std::vector<PointResult> results;
    for (const StudyPoint &point : points)
    {
      const double seed = std::stod(point.seed);
      const double cost = point.values[0] == "3000" ? 4.
                          : point.values[0] == "2000"
                              ? 2.
                              : 2. + dearer + scatter * (seed - 2.);
      results.push_back({true, "", {seed, cost}});
    }
    const StudyData data{map, points, results};
    const DefaultCost price = default_costs(data, level_costs(data)).front();
    EXPECT_EQ(price.default_value, "2750");
    EXPECT_EQ(price.cheapest, "2000");
    return price.is_right;
  };
  EXPECT_TRUE(verdict(0.05, 0.1));
  EXPECT_FALSE(verdict(0.05, 0.01));
}

// The cheapest may be a variant that has the default of the parameter, with the
// default of another key or with what saves besides; not with another value.
TEST_F(StudyFile, DefaultsInSetsAreTheDefault)
{
  const auto verdict = [&](const std::string &settings)
  {
    const Study map = read_study(write(
        "f.prm", "subsection Study\n  set case = c.prm\n"
                 "  set outcomes = n_events\n"
                 "  set seeds = 1, 2, 3\n  set cost = processor_s\nend\n"
                 "subsection Base\n  set Particle/density = 3000\n"
                 "  set Particle/friction = 0.4\nend\n"
                 "subsection Variants\n  set both = " +
                     settings +
                     "\nend\n"
                     "subsection Sweep\n  set Particle/density = 2750\nend\n"));
    const std::vector<StudyPoint> points = points_of(map);
    std::vector<PointResult> results;
    for (const StudyPoint &point : points)
      results.push_back(
          {true,
           "",
           {std::stod(point.seed), point.values[0] == "both"   ? 1.
                                   : point.values[1] == "2750" ? 3.
                                                               : 4.}});
    const StudyData data{map, points, results};
    const DefaultCost price = default_costs(data, level_costs(data)).front();
    EXPECT_EQ(price.parameter, "Particle/density");
    EXPECT_EQ(price.cheapest, "both");
    return price.is_right;
  };
  EXPECT_TRUE(verdict("Particle/density=2750; Particle/friction=0.5"));
  EXPECT_TRUE(verdict("Particle/density=2750; Particle/friction=0.3"));
  EXPECT_FALSE(verdict("Particle/density=2600; Particle/friction=0.5"));
}

// Two costs, a control and a variant that is the default; the cheapest that is
// fine is another value of its parameter.
TEST_F(StudyFile, DefaultsAreHeldAgainstTheMap)
{
  const Study map = read_study(
      write("d.prm",
            "subsection Study\n  set case = c.prm\n  set outcomes = n_events\n"
            "  set seeds = 1, 2, 3\n  set cost = processor_s, peak_memory_B\n"
            "  set controls = same\nend\n"
            "subsection Base\n  set Particle/density = 3000\n"
            "  set Particle/friction = 0.4\nend\n"
            "subsection Variants\n  set same = Particle/diameter=0.0300001\n"
            "  set usual = Particle/friction=0.5\nend\n"
            "subsection Sweep\n  set Particle/density = 2000, 2750\nend\n"));
  ASSERT_EQ(map.outcomes, (std::vector<std::string>{"n_events", "processor_s",
                                                    "peak_memory_B"}));
  const std::vector<StudyPoint> points = points_of(map);
  std::vector<PointResult> results;
  for (const StudyPoint &point : points)
  {
    const double seed = std::stod(point.seed);
    double error = 0., cost = 4.;
    if (point.values[0] == "same")
      cost = 1.;
    else if (point.values[1] == "2000")
      cost = 2.;
    else if (point.values[1] == "2750")
    {
      cost = 3.;
      error = 0.9;
    }
    results.push_back({true, "", {seed + error, cost, 10. * cost}});
  }
  const StudyData data{map, points, results};
  const std::vector<LevelCost> levels = level_costs(data);
  const auto named = [&](const std::string &value)
  { return *std::ranges::find(levels, value, &LevelCost::value); };
  EXPECT_TRUE(named("same").is_control);
  EXPECT_FALSE(named("same").is_on_front || named("same").is_cheapest_fine);
  EXPECT_EQ(named("2000").costs, (std::vector<double>{0.5, 0.5}));
  EXPECT_TRUE(named("2000").is_cheapest_fine);
  const std::vector<DefaultCost> defaults = default_costs(data, levels);
  const auto of = [&](const std::string &parameter)
  { return *std::ranges::find(defaults, parameter, &DefaultCost::parameter); };
  EXPECT_EQ(of("Particle/density").default_value, "2750");
  EXPECT_NEAR(of("Particle/density").worst, 0.9, 1e-12);
  EXPECT_EQ(of("Particle/density").cheapest, "2000");
  EXPECT_FALSE(of("Particle/density").is_right);
  EXPECT_EQ(of("Particle/friction").worst, 0.);
  EXPECT_EQ(of("Particle/friction").cheapest, "reference");
  EXPECT_TRUE(of("Particle/friction").is_right);
  EXPECT_THROW(
      read_study(write("x.prm", "subsection Study\n  set case = c.prm\n"
                                "  set outcomes = n_events\n"
                                "  set controls = none\nend\n"
                                "subsection Sweep\n"
                                "  set Particle/density = 2000\nend\n")),
      InputError);
}

// A value that gave no force is no choice, however near its other outcomes.
TEST_F(StudyFile, MissingOutcomesAreNoSmallErrors)
{
  const Study map = read_study(
      write("n.prm", "subsection Study\n  set case = c.prm\n"
                     "  set outcomes = peak_force_N, n_events, processor_s\n"
                     "  set seeds = 1, 2\n  set cost = processor_s\nend\n"
                     "subsection Sweep\n  set Particle/density = 2000\nend\n"));
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
  const std::vector<LevelCost> levels = level_costs({map, points, results});
  ASSERT_EQ(levels.size(), 1u);
  EXPECT_TRUE(std::isinf(levels[0].worst));
  EXPECT_FALSE(levels[0].is_on_front || levels[0].is_cheapest_fine);
}
} // namespace
