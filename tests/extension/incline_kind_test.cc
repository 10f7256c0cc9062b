#include "test_folder.h"

#include <gtest/gtest.h>

#include <case/file.h>
#include <cmath>
#include <errors.h>
#include <filesystem>
#include <fstream>
#include <incline_kind.h>
#include <numbers>
#include <report/figures.h>
#include <report/tables.h>
#include <run/options.h>

namespace
{
using namespace spall;
namespace fs = std::filesystem;

class InclineKind : public testing::Test
{
protected:
  static void SetUpTestSuite() { add_test_kind(incline_kind()); }
  void SetUp() override { folder = support::test_folder(); }

  std::string write_case(const std::string &values)
  {
    const std::string file = (folder / "case.prm").string();
    std::ofstream(file) << "subsection Case\n  set kind = incline\nend\n"
                        << values;
    return file;
  }
  /// The folder of the run.
  std::string run(const std::string &file, const RunOptions &with = {})
  {
    RunOptions options = with;
    options.case_file = file;
    options.out = (folder / "run").string();
    options.threads = 1;
    run_test(options, read_case(file, options.overrides));
    return options.out;
  }
  static std::string message_of(const std::string &file)
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

  fs::path folder;
};
} // namespace

// A sphere that rolls without slip: a = 5/7 g sin(angle).
TEST_F(InclineKind, RollsAsTheClosedFormSays)
{
  const RunData data = read_run(run(write_case(
      "subsection Incline\n  set angle = 25\n  set duration = 0.3\nend\n")));
  EXPECT_EQ(data.kind, "incline");
  const double expected = 0.5 * 5. / 7. * 9.81 *
                          std::sin(25. * std::numbers::pi / 180.) * 0.3 * 0.3;
  EXPECT_NEAR(number(data.summary, "path_m"), expected, 2e-3 * expected);
  EXPECT_TRUE(data.summary.at("is_complete").get<bool>());
}

TEST_F(InclineKind, HasKeysDocsAndChecksAsEveryKind)
{
  EXPECT_NE(parameter_tables().find("## Incline"), std::string::npos);
  EXPECT_NE(template_case("incline").find("subsection Incline"),
            std::string::npos);
  EXPECT_EQ(message_of(write_case("subsection Incline\n  set rows = 7\nend\n")),
            "");
  EXPECT_NE(
      message_of(write_case("subsection Incline\n  set angle = 95\nend\n"))
          .find("case.prm:5: Incline/angle = 95: must be"),
      std::string::npos);
  EXPECT_NE(
      message_of(write_case("subsection Wall\n  set friction = 0.01\nend\n"))
          .find("Wall/friction = 0.01: must be at least 2/7"),
      std::string::npos);
  EXPECT_NE(message_of(write_case("subsection Drum\n  set turns = 1\nend\n"))
                .find("a case of kind incline has no section Drum"),
            std::string::npos);
}

TEST_F(InclineKind, HasAReport)
{
  const std::string out = run(write_case(""));
  const RunData data = read_run(out);
  EXPECT_NE(headline({&data, 1}).find("Path"), std::string::npos);
  const std::vector<Chart> charts = make_charts({&data, 1});
  ASSERT_EQ(charts.size(), 1u);
  EXPECT_GE(charts[0].curves.at(0).x.size(), 100u);
}

// What rows says may change when a run is resumed, the angle may not.
TEST_F(InclineKind, ResumesWhereItMay)
{
  const std::string file = write_case("");
  run(file);
  RunOptions more;
  more.is_resumed = true;
  more.overrides = {parse_override("Incline/rows=50")};
  EXPECT_NO_THROW(run(file, more));
  more.overrides = {parse_override("Incline/angle=15")};
  EXPECT_THROW(run(file, more), InputError);
}
