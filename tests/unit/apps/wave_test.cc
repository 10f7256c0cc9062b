#include "errors.h"
#include "test_folder.h"
#include "triaxial/wave.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>

namespace
{
using namespace spall;

/// Mean over a pulse by the midpoint rule, which is exact on straight pieces
/// whose ends it meets.
double mean_of(const Wave &wave)
{
  constexpr int n = 6000;
  double sum = 0.;
  for (int k = 0; k < n; ++k)
    sum += wave.value((k + 0.5) / n);
  return sum / n;
}

Wave wave_of(WaveForm form)
{
  return {form, 2.};
}

std::string file_with(const std::string &text)
{
  const auto path = support::test_folder() / "wave_test.csv";
  std::ofstream(path) << text;
  return path.string();
}

std::string message_of(const std::string &text)
{
  try
  {
    read_wave_table(file_with(text));
  }
  catch (const InputError &error)
  {
    return error.what();
  }
  return "accepted";
}
} // namespace

TEST(Wave, ValuesAtChosenPhases)
{
  for (const double x : {0.1, 0.3, 0.77})
  {
    const double sine = std::sin(std::numbers::pi * x);
    EXPECT_NEAR(wave_value(WaveForm::haversine, x), sine * sine, 1e-15);
    EXPECT_NEAR(wave_value(WaveForm::sine, x),
                std::sin(2. * std::numbers::pi * x), 1e-15);
  }
  EXPECT_DOUBLE_EQ(wave_value(WaveForm::triangular, 0.25), 0.5);
  EXPECT_DOUBLE_EQ(wave_value(WaveForm::triangular, 0.5), 1.);
  EXPECT_DOUBLE_EQ(wave_value(WaveForm::square, 0.025), 0.5);
  EXPECT_DOUBLE_EQ(wave_value(WaveForm::square, 0.4), 1.);
  EXPECT_DOUBLE_EQ(wave_value(WaveForm::square, 0.6), 0.);
  // Two axles: full load under each, half of it between them, then rest.
  EXPECT_NEAR(wave_value(WaveForm::pulse, 0.15), 1., 1e-15);
  EXPECT_NEAR(wave_value(WaveForm::pulse, 0.25), 0.5, 1e-15);
  EXPECT_NEAR(wave_value(WaveForm::pulse, 0.35), 1., 1e-15);
  EXPECT_EQ(wave_value(WaveForm::pulse, 0.6), 0.);
}

TEST(Wave, MeansOfAPulse)
{
  // Trigonometric sums over whole periods are exact to round-off; the midpoint
  // rule meets every corner of the others, whose smooth parts it has to 1e-7.
  EXPECT_NEAR(mean_of(wave_of(WaveForm::haversine)), 0.5, 1e-12);
  EXPECT_NEAR(mean_of(wave_of(WaveForm::sine)), 0., 1e-12);
  EXPECT_NEAR(mean_of(wave_of(WaveForm::square)), 0.5, 1e-12);
  EXPECT_NEAR(mean_of(wave_of(WaveForm::triangular)), 0.5, 1e-12);
  EXPECT_NEAR(mean_of(wave_of(WaveForm::pulse)), 0.3, 1e-7);
}

TEST(Wave, RestFollowsThePulse)
{
  // 0.5 s of pulse, 1.5 s of rest: a quarter of the cycle is the pulse.
  const Wave wave{WaveForm::haversine, 2., 1.5};
  EXPECT_DOUBLE_EQ(wave.period(), 2.);
  EXPECT_NEAR(wave.value(0.125), 1., 1e-15);
  EXPECT_DOUBLE_EQ(wave.peak(), 0.125);
  EXPECT_EQ(wave.value(0.3), 0.);
  EXPECT_NEAR(mean_of(wave), 0.125, 1e-12);
}

TEST(Wave, PeaksAreTheLargestValues)
{
  for (const WaveForm form :
       {WaveForm::haversine, WaveForm::sine, WaveForm::square,
        WaveForm::triangular, WaveForm::pulse})
    EXPECT_NEAR(wave_of(form).value(wave_of(form).peak()), 1., 1e-12);
}

TEST(Wave, TableIsInterpolatedByStraightLines)
{
  Wave wave{WaveForm::table, 1.};
  wave.table = read_wave_table(
      file_with("# points\nshare_1,value_1\n0,0\n0.2,1\n0.6,-0.5\n1,0\n"));
  EXPECT_DOUBLE_EQ(wave.value(0.1), 0.5);
  EXPECT_NEAR(wave.value(0.4), 0.25, 1e-15);
  EXPECT_DOUBLE_EQ(wave.value(1.), 0.);
  EXPECT_DOUBLE_EQ(wave.peak(), 0.2);
  // (0.2 1 + 0.4 (1 - 0.5) - 0.4 0.5) / 2
  EXPECT_NEAR(mean_of(wave), 0.1, 1e-12);
}

TEST(Wave, TablesAreRefusedWithTheirLine)
{
  EXPECT_NE(message_of("share,value\n").find(":1: "), std::string::npos);
  EXPECT_NE(message_of("share_1,value_1\n0,0\n0.5,x\n").find(":3: \"0.5,x\""),
            std::string::npos);
  EXPECT_NE(message_of("share_1,value_1\n0,0\n0.5,1\n0.4,0\n").find("ascend"),
            std::string::npos);
  EXPECT_NE(message_of("share_1,value_1\n0,0\n0.5,2\n1,0\n").find("amplitude"),
            std::string::npos);
  EXPECT_NE(message_of("share_1,value_1\n0,0\n1,1\n").find("the last 1,0"),
            std::string::npos);
}
