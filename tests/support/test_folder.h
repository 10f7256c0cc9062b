#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <unistd.h>

namespace support
{
/// The folder of the running test: empty when it is first asked for, and
/// removed when the program ends. No other test and no other process shares
/// it, for ctest runs tests side by side.
inline std::filesystem::path test_folder()
{
  struct Root
  {
    Root()
        : path(std::filesystem::path(testing::TempDir()) /
               ("spall_tests_" + std::to_string(getpid())))
    {
      std::filesystem::remove_all(path);
    }
    ~Root()
    {
      std::error_code ignored;
      std::filesystem::remove_all(path, ignored);
    }
    std::filesystem::path path;
  };
  static const Root root;
  const testing::TestInfo &test =
      *testing::UnitTest::GetInstance()->current_test_info();
  const std::filesystem::path folder =
      root.path / test.test_suite_name() / test.name();
  std::filesystem::create_directories(folder);
  return folder;
}
} // namespace support
