#include "triaxial/load_follower.h"

#include <gtest/gtest.h>

#include <cmath>
#include <sstream>
#include <stdexcept>

namespace
{
using namespace spall;

constexpr double confining = 50e3; // [Pa]

LoadStage ramp(double axial_stress, double duration)
{
  LoadStage stage;
  stage.name = "ramp";
  stage.axial = {LoadControl::stress, axial_stress, {}};
  stage.duration = duration;
  return stage;
}

LoadStage haversine(double amplitude, int cycles)
{
  LoadStage stage;
  stage.name = "wave";
  stage.wave = {WaveForm::haversine, 10.};
  stage.amplitude = amplitude;
  stage.cycles = cycles;
  return stage;
}

/// A specimen of 0.1 m.
LoadMeasures measures(double axial = confining, double lateral = confining)
{
  LoadMeasures m;
  m.height = 0.1;
  m.volume = 1e-3;
  m.axial_stress = m.drive_stress = axial;
  m.side_stress = {lateral, lateral};
  return m;
}

StagePosition at(double cycles)
{
  return {cycles, cycles - std::floor(cycles), cycles, 1e-4};
}
} // namespace

TEST(LoadFollower, StressesGoStraightToTheirTargets)
{
  LoadStage stage = ramp(90e3, 2.);
  stage.sides.fill({LoadControl::stress, {}, -10e3});
  LoadFollower follower({{stage}}, confining);
  follower.begin(measures(), 0.);
  EXPECT_EQ(follower.period(), 2.);
  follower.aim(at(0.25));
  EXPECT_DOUBLE_EQ(follower.axial_target(), 60e3);
  EXPECT_DOUBLE_EQ(follower.side_target(0), 45e3);
  follower.aim(at(1.));
  EXPECT_DOUBLE_EQ(follower.axial_target(), 90e3);
  EXPECT_DOUBLE_EQ(follower.side_target(1), 30e3);
}

TEST(LoadFollower, WavesStandOnTheStressBefore)
{
  LoadFollower follower({{ramp(60e3, 1.), haversine(40e3, 3)}}, confining);
  follower.begin(measures(), 0.);
  follower.aim(at(1.));
  follower.end_interval(measures(), 1., 1.);
  EXPECT_TRUE(follower.is_over());
  follower.begin(measures(), 1.);
  EXPECT_DOUBLE_EQ(follower.period(), 0.1);
  follower.aim(at(1.5));
  EXPECT_DOUBLE_EQ(follower.axial_target(), 100e3);
  follower.aim(at(1.25));
  EXPECT_DOUBLE_EQ(follower.axial_target(), 80e3);
  EXPECT_DOUBLE_EQ(follower.side_target(0), confining);
  follower.end_interval(measures(), 2.5, 1.);
  EXPECT_FALSE(follower.is_over());
  follower.end_interval(measures(), 3., 1.);
  EXPECT_TRUE(follower.is_over() && follower.is_last());
  EXPECT_DOUBLE_EQ(follower.cycles_at(0.05), 1.5);
}

TEST(LoadFollower, SidesSwingInPhaseAndApart)
{
  LoadStage stage = haversine(40e3, 2);
  stage.side_amplitude = 10e3;
  stage.sides[0] = {LoadControl::stress, 70e3, {}};
  LoadFollower follower({{stage}}, confining);
  follower.begin(measures(), 0.);
  follower.aim(at(0.5));
  EXPECT_DOUBLE_EQ(follower.side_target(0), confining + 5e3 + 10e3);
  EXPECT_DOUBLE_EQ(follower.side_target(1), confining + 10e3);
  follower.aim(at(2.));
  EXPECT_DOUBLE_EQ(follower.side_target(0), 70e3);
  EXPECT_DOUBLE_EQ(follower.side_target(1), confining);
}

LoadMeasures at_strain(double strain)
{
  LoadMeasures now = measures();
  now.axial_strain = strain;
  return now;
}

/// At 0.2 per second from now on.
LoadFollower driven_to(double strain, const LoadMeasures &now)
{
  LoadStage stage;
  stage.axial = {LoadControl::strain, strain, 0.2};
  LoadFollower follower({{stage}}, confining);
  follower.begin(now, 0.);
  return follower;
}

TEST(LoadFollower, TargetAndRateGiveTheLength)
{
  const LoadMeasures now = at_strain(0.01);
  LoadFollower follower = driven_to(0.03, now);
  EXPECT_DOUBLE_EQ(follower.period(), 0.1);
  EXPECT_TRUE(std::isnan(follower.axial_target()));
  // The speed is reached in the first hundredth: 0.02 of 0.1 m in 0.1 s less
  // half of that, all of it afterwards.
  const double speed = 0.02 * 0.1 / (0.1 * 0.995);
  EXPECT_NEAR(follower.plate_acceleration(now, at(0.005), 0.1), -speed / 1e-3,
              1e-9);
  EXPECT_EQ(follower.plate_acceleration(now, at(0.5), 0.1), 0.);
}

// Its first hundredth, 1 ms, is no whole number of steps: the plate has its
// speed to round-off all the same.
TEST(LoadFollower, DrivenPlateMeetsItsSpeedInAnySteps)
{
  const LoadMeasures now = at_strain(0.01);
  LoadFollower follower = driven_to(0.03, now);
  const double expected = 0.02 * 0.1 / (0.1 * 0.995);
  for (const double step : {1e-5, 3e-5, 0.7e-3, 4e-3})
  {
    double speed = 0.;
    for (int k = 0; k * step < 0.02; ++k)
    {
      const StagePosition end{.cycles = (k + 1) * step / 0.1,
                              .phase = 0.,
                              .cycles_before = k * step / 0.1,
                              .step = step};
      speed -= step * follower.plate_acceleration(now, end, 0.1);
    }
    EXPECT_NEAR(speed, expected, 1e-9 * expected) << step;
  }
}

TEST(LoadFollower, MeanStressStaysOnAPathOfConstantP)
{
  LoadStage stage = ramp(110e3, 1.);
  stage.rule = SideRule::proportional;
  stage.side_ratio = -0.5;
  LoadFollower follower({{stage}}, confining);
  follower.begin(measures(), 0.);
  for (const double share : {0.1, 0.6, 1.})
  {
    follower.aim(at(share));
    EXPECT_NEAR((follower.axial_target() + 2. * follower.side_target(0)) / 3.,
                confining, 1e-10);
  }
  EXPECT_DOUBLE_EQ(follower.side_target(0), 20e3);
}

TEST(LoadFollower, SidesFollowTheMeasuredStressOfADrivenPlate)
{
  LoadStage stage;
  stage.axial = {LoadControl::strain, 0.1, 0.1};
  stage.rule = SideRule::proportional;
  stage.side_ratio = 0.4;
  LoadFollower follower({{stage}}, confining);
  follower.begin(measures(), 0.);
  for (int step = 0; step < 200; ++step)
    follower.observe(measures(80e3), 1e-4, 5e-4);
  follower.aim(at(0.2));
  EXPECT_NEAR(follower.side_target(0), confining + 0.4 * 30e3, 1e-6);
}

TEST(LoadFollower, SidesTakeWhatThePlateGives)
{
  LoadStage stage;
  stage.axial = {LoadControl::strain, 0.1, 0.1};
  stage.rule = SideRule::constant_volume;
  LoadFollower follower({{stage}}, confining);
  LoadMeasures now = measures();
  follower.begin(now, 0.);
  EXPECT_TRUE(follower.is_side_moved(0));
  now.plate_speed = 0.01; // 0.1 of the height in a second
  EXPECT_DOUBLE_EQ(follower.side_rate(0, now, 1e-3), -0.05);
  now.volume *= 1.001; // an error is taken back within the response time
  EXPECT_NEAR(follower.side_rate(0, now, 1e-3), 0.5 - 0.05, 1e-9);
}

TEST(LoadFollower, StagesEndByTheirConditions)
{
  LoadStage stage = ramp(150e3, 1.);
  stage.until_ratio = 0.5;
  stage.until_unbalanced = 1e-3;
  LoadFollower follower({{stage}}, confining);
  follower.begin(measures(), 0.);
  follower.end_interval(measures(), 0.2, 2e-3);
  EXPECT_FALSE(follower.is_over());
  // q / p = 0.5 at an axial stress of 80 kPa: (80 - 50) / 60.
  for (int step = 0; step < 200; ++step)
    follower.observe(measures(79e3), 1e-4, 5e-4);
  follower.end_interval(measures(), 0.3, 2e-3);
  EXPECT_FALSE(follower.is_over());
  for (int step = 0; step < 200; ++step)
    follower.observe(measures(81e3), 1e-4, 5e-4);
  follower.end_interval(measures(), 0.4, 2e-3);
  EXPECT_TRUE(follower.is_over());
  EXPECT_EQ(follower.runs().back().is_met, 1);
}

TEST(LoadFollower, KeptStressesStayAndKeptMotionsStop)
{
  LoadStage drive, keep;
  drive.axial = {LoadControl::strain, {}, 0.1};
  drive.duration = keep.duration = 1.;
  LoadFollower follower({{drive, keep, ramp(70e3, 1.)}}, confining);
  follower.begin(measures(), 0.);
  LoadMeasures now = measures(90e3);
  now.plate_speed = 0.01;
  follower.begin(now, 1.);
  EXPECT_TRUE(follower.is_driven());
  // Slowed down over a hundredth of the stage.
  EXPECT_DOUBLE_EQ(follower.plate_acceleration(now, at(0.), 0.1), 1.);
  // A stress begins at what the plate bears.
  follower.begin(now, 2.);
  EXPECT_FALSE(follower.is_driven());
  follower.aim(at(0.5));
  EXPECT_DOUBLE_EQ(follower.axial_target(), 80e3);
}

TEST(LoadFollower, ContinuesWithMoreStagesAndRefusesOthers)
{
  LoadFollower first({{ramp(60e3, 1.), haversine(40e3, 3)}}, confining);
  first.begin(measures(), 0.);
  first.begin(measures(), 1.);
  first.aim(at(0.3));
  std::stringstream state;
  first.save(state);
  LoadFollower longer({{ramp(60e3, 1.), haversine(40e3, 5), ramp(50e3, 1.)}},
                      confining);
  longer.restore(state);
  EXPECT_EQ(longer.axial_target(), first.axial_target());
  EXPECT_EQ(longer.index(), 1u);
  EXPECT_FALSE(longer.is_last());
  for (LoadPath path : {LoadPath{{ramp(61e3, 1.), haversine(40e3, 3)}},
                        LoadPath{{ramp(60e3, 1.), haversine(41e3, 3)}},
                        LoadPath{{ramp(60e3, 1.)}}})
  {
    LoadFollower other(path, confining);
    state.clear();
    state.seekg(0);
    EXPECT_THROW(other.restore(state), std::runtime_error);
  }
}
