#include "run/progress.h"
#include "run/refusals.h"
#include "run/scratch_folder.h"
#include "run/time_left.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <sstream>

namespace
{
/// What `call` prints.
template <class Call>
std::string printed(const Call &call)
{
  testing::internal::CaptureStdout();
  call();
  return testing::internal::GetCapturedStdout();
}
} // namespace

// Elsewhere than on a terminal every line stays.
TEST(Progress, ShowsPhaseShareRateAndNumbers)
{
  spall::Progress progress("/dev/null");
  EXPECT_EQ(
      printed([&] { progress.show("preparation", 0., 1234.4, "stress 3"); }),
      "preparation     0.0 %      1234 steps/s  stress 3\n");
}

// A ratio that falls by e in ten seconds, and wobbles.
TEST(RestTime, GoesByTheRateOfTheFall)
{
  spall::RestTime rest(1e-3);
  const auto ratio = [](double t) { return 0.1 * std::exp(-0.1 * t); };
  EXPECT_TRUE(std::isnan(rest.after(0., ratio(0.))));
  const double end = 10. * std::log(100.);
  EXPECT_NEAR(rest.after(10., ratio(10.)), end - 10., 1e-9);
  EXPECT_NEAR(rest.after(15., 2. * ratio(10.)), end - 15., 1e-9);
  EXPECT_NEAR(rest.after(20., ratio(20.)), end - 20., 1e-9);
}

TEST(TimeLeft, GoesByWhatGrew)
{
  spall::TimeLeft left;
  EXPECT_TRUE(std::isnan(left.after(0., 0.)));
  EXPECT_DOUBLE_EQ(left.after(10., 0.25), 30.);
  // Slower since: the last half of the time counts.
  EXPECT_DOUBLE_EQ(left.after(21., 0.375), 11. * 0.625 / 0.125);
}

// A preparation says nothing of the rest.
TEST(TimeLeft, BeginsAnewWhereNothingGrew)
{
  spall::TimeLeft left;
  EXPECT_TRUE(std::isnan(left.after(0., 0.)));
  EXPECT_TRUE(std::isnan(left.after(1000., 0.)));
  EXPECT_DOUBLE_EQ(left.after(1010., 0.1), 90.);
}

TEST(Progress, KeepsWhatItSaysInTheLog)
{
  const spall::ScratchFolder folder;
  const std::string path = (folder.path() / "log.txt").string();
  printed(
      [&]
      {
        spall::Progress progress(path);
        progress.show("cycle", 0.5, 1., "");
        progress.say("first");
        progress.say("second");
      });
  std::stringstream text;
  text << std::ifstream(path).rdbuf();
  EXPECT_EQ(text.str(), "first\nsecond\n");
}

TEST(Refusals, AreSaidAtFirstAndWhenTheyHaveDoubled)
{
  spall::Refusals refusals(0);
  EXPECT_EQ(refusals.news(0, 1.), "");
  EXPECT_NE(refusals.news(1, 0.25).find("by 0.25 s 1 breakage event was"),
            std::string::npos);
  EXPECT_EQ(refusals.news(1, 2.), "");
  EXPECT_NE(refusals.news(3, 3.).find("3 breakage events were"),
            std::string::npos);
  EXPECT_EQ(refusals.news(5, 4.), "");
  EXPECT_NE(refusals.news(6, 5.), "");
}

// A run that is gone on with does not say again what it has said.
TEST(Refusals, GoOnFromThoseThatAreKnown)
{
  spall::Refusals refusals(4);
  EXPECT_EQ(refusals.news(4, 1.), "");
  EXPECT_EQ(refusals.news(7, 1.), "");
  EXPECT_NE(refusals.news(8, 1.), "");
}
