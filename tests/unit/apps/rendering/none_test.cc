#include "report/pictures.h"

#include <gtest/gtest.h>

namespace
{
TEST(NoPictures, EachOneNamesTheSwitch)
{
  const std::vector<std::string> folders{"a", "b"};
  const auto pictures = spall::draw_pictures(folders);
  ASSERT_EQ(pictures.size(), folders.size());
  for (const spall::RunPictures &run : pictures)
    for (const spall::Picture &one : {run.specimen, run.network, run.ground})
    {
      EXPECT_TRUE(one.png.empty());
      EXPECT_EQ(one.problem, "this program was built without pictures "
                             "(SPALL_RENDERING = OFF).");
    }
}
} // namespace
