#pragma once

#include "study/study.h"
#include "test_folder.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

namespace spall
{
namespace fs = std::filesystem;

/// A folder with the case c.prm and the studies of a test.
class StudyFile : public testing::Test
{
protected:
  void SetUp() override
  {
    folder = support::test_folder();
    write("c.prm", "subsection Case\n  set kind = single_particle\nend\n"
                   "subsection Particle\n  set shape =\nend\n");
  }

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
                           "  set Particle/density = 2000, 2750, 3000\n"
                           "  set Time/fixed_step = 1e-6, 2e-6\nend\n"));
  }

  fs::path folder;
};
} // namespace spall
