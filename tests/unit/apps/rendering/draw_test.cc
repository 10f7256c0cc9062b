#include "report/pictures.h"
#include "test_folder.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

namespace
{
namespace fs = std::filesystem;

TEST(Pictures, MissingAndUnreadableFramesAreNamed)
{
  const fs::path folder = support::test_folder();
  fs::create_directories(folder / "bare");
  fs::create_directories(folder / "broken" / "frames");
  std::ofstream(folder / "broken" / "frames" / "surfaces_00000.vtu")
      << "no XML";
  const std::vector<std::string> folders{(folder / "bare").string(),
                                         (folder / "broken").string()};
  const auto pictures = spall::draw_pictures(folders);
  ASSERT_EQ(pictures.size(), 2u);
  for (const spall::RunPictures &one : pictures)
    EXPECT_TRUE(one.specimen.png.empty());
  EXPECT_EQ(pictures[0].specimen.problem, "there is no frames/surfaces_*.vtu.");
  EXPECT_EQ(pictures[0].network.problem, "there is no frames/contacts_*.vtu.");
  EXPECT_EQ(pictures[0].ground.problem, "");
  // A machine may have no EGL.
  const std::string &problem = pictures[1].specimen.problem;
  EXPECT_TRUE(problem.find("cannot be read") != std::string::npos ||
              problem.find("no EGL") != std::string::npos)
      << problem;
}
} // namespace
