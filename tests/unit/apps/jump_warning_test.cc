#include "run/warnings.h"

#include <gtest/gtest.h>

namespace
{
using coupling::JumpAccount;

std::vector<std::string> warned(const JumpAccount &jumps, double strain,
                                double laa)
{
  std::vector<std::string> warnings;
  spall::add_jump_warning(jumps, 0.1, {1000., strain, laa}, warnings);
  return warnings;
}

TEST(JumpWarning, SpeaksOfErrorsAboveTheTolerance)
{
  JumpAccount jumps;
  jumps.strain_error = -0.0101;
  const auto lines = warned(jumps, 0.1, 0.4);
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_NE(lines[0].find("-10.1 % of the permanent axial strain"),
            std::string::npos)
      << lines[0];
  jumps.abrasion_error = 0.0404;
  EXPECT_EQ(warned(jumps, 0.1, 0.4).size(), 2u);
}

TEST(JumpWarning, IsSilentWithinTheToleranceAndWithoutJumps)
{
  JumpAccount jumps;
  EXPECT_TRUE(warned(jumps, 0.1, 0.4).empty());
  EXPECT_TRUE(warned(jumps, 0., 0.).empty());
  jumps.strain_error = -0.0099;
  jumps.abrasion_error = 0.0396;
  EXPECT_TRUE(warned(jumps, 0.1, 0.4).empty());
}
} // namespace
