#include "run/progress.h"
#include "run/refusals.h"
#include "run/scratch_folder.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cstdio>
#include <fstream>
#include <sstream>
#include <thread>

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

void wait(int milliseconds)
{
  std::this_thread::sleep_for(std::chrono::milliseconds(milliseconds));
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

// A ten-thousandth in so many seconds: ten thousand times as many are left.
TEST(Progress, TimeLeftGoesByWhatGrew)
{
  spall::Progress progress("/dev/null");
  const auto shown = [&](double share)
  { return printed([&] { progress.show("cycle", share, 1., ""); }); };
  EXPECT_EQ(shown(0.).find("left"), std::string::npos);
  wait(200);
  EXPECT_EQ(shown(0.).find("left"), std::string::npos);
  wait(40);
  int minutes = 0, seconds = 0;
  ASSERT_EQ(std::sscanf(shown(1e-4).c_str(),
                        "cycle 0.0 %% 1 steps/s %d:%d left", &minutes,
                        &seconds),
            2);
  EXPECT_GE(60 * minutes + seconds, 400);
  // What stood still before would make it 2400.
  EXPECT_LT(60 * minutes + seconds, 2000);
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
