#include "study/study.h"

#include <gtest/gtest.h>

#include <filesystem>

namespace
{
using namespace spall;
namespace fs = std::filesystem;

std::vector<std::string> files_in(const std::string &folder)
{
  std::vector<std::string> files;
  for (const auto &entry :
       fs::directory_iterator(fs::path(SPALL_DATA) / folder))
    files.push_back(entry.path().string());
  EXPECT_GT(files.size(), 5u) << folder;
  return files;
}

// Full sizes included, which no test runs.
TEST(ShippedFiles, CasesAreRead)
{
  for (const std::string &file : files_in("cases"))
    EXPECT_EQ(read_case(file, {}).notices, std::vector<std::string>{}) << file;
}

TEST(ShippedFiles, StudiesHaveTheirCases)
{
  for (const std::string &file : files_in("studies"))
  {
    const Study study = read_study(file);
    std::vector<StudyPoint> points;
    EXPECT_NO_THROW(points = points_of(study)) << file;
    EXPECT_GT(points.size(), 1u) << file;
    EXPECT_EQ(notices_of(points), std::vector<std::string>{}) << file;
  }
}
} // namespace
