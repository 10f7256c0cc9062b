#include "case/parameter.h"

#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>

namespace
{
using namespace spall;

TEST(Range, KeepsItsEnds)
{
  EXPECT_TRUE(between(0., 1.).contains(0.));
  EXPECT_TRUE(between(0., 1.).contains(1.));
  EXPECT_FALSE(above(0., 1.).contains(0.));
  EXPECT_FALSE(below(0., 1.).contains(1.));
}

TEST(Number, TextReadsBackTheSame)
{
  for (const double value : {0.1, 1. / 3., 2e-6, 1e300, -0., 5e8})
    EXPECT_EQ(to_number(number_text(value)), value);
}

TEST(Number, RefusesWhatIsNotOne)
{
  for (const char *text : {"", "1,5", "1e", "0x10", "nan", "inf", "1 2", "++1"})
    EXPECT_THROW(to_number(text), std::invalid_argument) << text;
  EXPECT_EQ(to_number("+1.5"), 1.5);
}

TEST(Assign, RefusesFractionsOfWholeNumbers)
{
  int n = 3;
  const Parameter p{"A", "n", "-", "Count.", &n, between(1, 10), ""};
  EXPECT_THROW(assign(p, "2.5"), std::invalid_argument);
  EXPECT_THROW(assign(p, "11"), std::invalid_argument);
  EXPECT_EQ(n, 3);
  assign(p, "4");
  EXPECT_EQ(n, 4);
}

TEST(Nearest, FindsTypingErrorsOnly)
{
  const std::vector<std::string> known = {"friction", "density"};
  EXPECT_EQ(nearest("frction", known), "friction");
  EXPECT_EQ(nearest("zzzzzz", known), "");
}
} // namespace
