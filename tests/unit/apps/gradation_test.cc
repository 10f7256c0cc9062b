#include "errors.h"
#include "specimen/gradation.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

namespace
{
TEST(Gradation, ReadsRowsAndSkipsComments)
{
  const std::string path = testing::TempDir() + "/gradation_test.csv";
  std::ofstream(path) << "# stones\n\ndiameter_m, passing_1\r\n"
                         "0.005, 0\n# middle\n0.01, 0.25\n0.02, 1\n";
  const spall::Gradation curve = spall::read_gradation(path);
  EXPECT_EQ(curve.diameter, (std::vector<double>{0.005, 0.01, 0.02}));
  EXPECT_EQ(curve.passing, (std::vector<double>{0., 0.25, 1.}));
  std::filesystem::remove(path);
}

TEST(Gradation, ReadsWhatSpreadsheetsWrite)
{
  const std::string path = testing::TempDir() + "/gradation_test_mark.csv";
  std::ofstream(path) << "\xEF\xBB\xBF"
                         "diameter_m,passing_1\r\n0.005,0\r\n0.01,1\r\n";
  EXPECT_EQ(spall::read_gradation(path).passing, (std::vector<double>{0., 1.}));
  std::filesystem::remove(path);
}

TEST(Gradation, RefusesAFolder)
{
  EXPECT_THROW(spall::read_gradation(testing::TempDir()), spall::InputError);
}
} // namespace
