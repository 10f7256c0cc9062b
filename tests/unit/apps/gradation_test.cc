#include "errors.h"
#include "specimen/gradation.h"
#include "test_folder.h"

#include <gtest/gtest.h>

#include <fstream>

namespace
{
TEST(Gradation, ReadsRowsAndSkipsComments)
{
  const std::string path =
      (support::test_folder() / "gradation_test.csv").string();
  std::ofstream(path) << "# particles\n\ndiameter_m, passing_1\r\n"
                         "0.005, 0\n# middle\n0.01, 0.25\n0.02, 1\n";
  const spall::Gradation curve = spall::read_gradation(path);
  EXPECT_EQ(curve.diameter, (std::vector<double>{0.005, 0.01, 0.02}));
  EXPECT_EQ(curve.passing, (std::vector<double>{0., 0.25, 1.}));
}

TEST(Gradation, ReadsWhatSpreadsheetsWrite)
{
  const std::string path =
      (support::test_folder() / "gradation_test_mark.csv").string();
  std::ofstream(path) << "\xEF\xBB\xBF"
                         "diameter_m,passing_1\r\n0.005,0\r\n0.01,1\r\n";
  EXPECT_EQ(spall::read_gradation(path).passing, (std::vector<double>{0., 1.}));
}

class GradationFile : public testing::Test
{
protected:
  std::string path =
      (support::test_folder() / "gradation_file_test.csv").string();

  /// Message of the refusal; empty: the file was read.
  std::string refusal(const std::string &text) const
  {
    std::ofstream(path) << text;
    try
    {
      spall::read_gradation(path);
    }
    catch (const spall::InputError &error)
    {
      return error.what();
    }
    return "";
  }
};

// No particle has a size below the last 0 or above the first 1.
TEST_F(GradationFile, LeavesOutRowsWithoutMass)
{
  std::ofstream(path) << "diameter_m,passing_1\n0.0001,0\n0.02,0\n0.022,0.4\n"
                         "0.023,0.4\n0.025,1\n0.0315,1\n0.063,1\n";
  const spall::Gradation curve = spall::read_gradation(path);
  EXPECT_EQ(curve.diameter, (std::vector<double>{0.02, 0.022, 0.023, 0.025}));
  EXPECT_EQ(curve.passing, (std::vector<double>{0., 0.4, 0.4, 1.}));
}

TEST_F(GradationFile, SaysThatDiametersAreInMetres)
{
  const std::string hint = "mm must be divided by 1000";
  EXPECT_NE(refusal("diameter_mm,passing_1\n7.1,0\n22.4,1\n").find(hint),
            std::string::npos);
  EXPECT_NE(refusal("diameter_m,passing_1\n7.1,0\n22.4,1\n")
                .find(":3: \"22.4,1\": the diameter must be at most 10 m; "
                      "diameters are in m, so those of a table in " +
                      hint),
            std::string::npos);
  EXPECT_EQ(refusal("diameter_m,passing_1\n0.5,0\n8,1\n"), "");
  EXPECT_NE(spall::largest_text(spall::read_gradation(path)).find(hint),
            std::string::npos);
  EXPECT_EQ(spall::largest_text({{0.01, 0.0224}, {0., 1.}}), "0.0224 m");
  EXPECT_NE(
      refusal("diameter_m,passing_1\n0.01,0\n0.02,100\n").find("per cent"),
      std::string::npos);
}

TEST(Gradation, RefusesAFolder)
{
  EXPECT_THROW(spall::read_gradation(testing::TempDir()), spall::InputError);
}
} // namespace
