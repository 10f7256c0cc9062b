#include "errors.h"
#include "study/levels.h"

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
  const std::vector<Level> levels = levels_of({each, points, results}, 0, 0);
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
  { return judge(levels(means), relation).is_shown; };
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
  EXPECT_FALSE(judge(missing, "rises").is_shown);
}
} // namespace
