#include <dem/boundary/wall_motion.h>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

using dem::Vec3;
using dem::WallMotion;
using dem::WallPose;

namespace
{
WallPose after(const WallMotion &motion, double time, int n_steps,
               const dem::WallLoad &load = {})
{
  WallPose pose;
  for (int step = 0; step < n_steps; ++step)
    pose = dem::advanced(motion, pose, load, time / n_steps);
  return pose;
}
} // namespace

TEST(WallMotion, SumOfVelocitySineAndTable)
{
  WallMotion motion;
  motion.velocity = {0.1, 0., 0.};
  motion.amplitude = {0., 0.02, 0.};
  motion.frequency = 3.;
  motion.table_time = {0., 1., 3.};
  motion.table_shift = {Vec3::Zero(), Vec3(0., 0., 0.4), Vec3(0., 0., 0.2)};
  motion.start = 0.5;
  for (const double time : {0.7, 1.9, 5.})
  {
    const double t = time - 0.5;
    const WallPose pose = after(motion, time, 100);
    const double table = t < 1. ? 0.4 * t : t < 3. ? 0.4 - 0.1 * (t - 1.) : 0.2;
    EXPECT_NEAR(pose.shift.x(), 0.1 * t, 1e-12);
    EXPECT_NEAR(pose.shift.y(), 0.02 * std::sin(6. * std::numbers::pi * t),
                1e-12);
    EXPECT_NEAR(pose.shift.z(), table, 1e-12);
  }
  EXPECT_TRUE(after(motion, 0.4, 10).shift.isZero(0.));
}

// Velocity Verlet is exact for a constant force but for its first half step.
TEST(WallMotion, ForcesMoveFreeDirectionsAlone)
{
  WallMotion motion;
  motion.velocity = {0.3, 0.3, 0.3};
  motion.free = Vec3::UnitZ();
  motion.mass = 2.;
  motion.force = {5., 5., 5.};
  const dem::WallLoad load{Vec3(1., 1., 1.), Vec3::Zero()};
  const double time = 0.7;
  const int n = 1000;
  const WallPose pose = after(motion, time, n, load);
  const double exact = 0.5 * (6. / 2.) * time * time;
  EXPECT_NEAR(pose.shift.z(), exact * (1. + 1. / n), 1e-12);
  EXPECT_NEAR(pose.velocity.z(), 3. * time, 1e-12);
  EXPECT_NEAR(pose.shift.x(), 0.3 * time, 1e-12);
}

// The impulse of whole haversines is half of their peak.
TEST(WallMotion, CyclicForceAndLargestSpeed)
{
  WallMotion motion;
  motion.free = Vec3::UnitX();
  motion.mass = 4.;
  motion.force_amplitude = {10., 10., 10.};
  motion.frequency = 5.;
  EXPECT_NEAR(after(motion, 0.6, 6000).velocity.x(), 0.5 * 10. / 4. * 0.6,
              1e-12);
  EXPECT_NEAR(dem::driving_force(motion, 0.1).x(), 10., 1e-12);
  motion.largest_speed = 0.2;
  const WallPose pose = after(motion, 0.6, 6000);
  EXPECT_EQ(pose.velocity.x(), 0.2);
  EXPECT_LT(pose.shift.x(), 0.12);
}

TEST(WallMotion, TorqueTurnsAWallWithInertia)
{
  WallMotion motion;
  motion.axis = Vec3::UnitY();
  motion.centre = {1., 0., 0.};
  motion.inertia = 0.5;
  motion.torque = 2.;
  const dem::WallLoad load{Vec3::Zero(), Vec3(9., -0.5, 9.)};
  const WallPose pose = after(motion, 0.2, 1000, load);
  EXPECT_NEAR(pose.spin, 3. * 0.2, 1e-12);
  EXPECT_NEAR(pose.angle, 0.5 * 3. * 0.04 * 1.001, 1e-12);
  // A point beside the axis, turned right-handed about y.
  const Vec3 point = dem::WallTransform(motion, pose)(Vec3(1., 0., 1.));
  EXPECT_NEAR(point.x(), 1. + std::sin(pose.angle), 1e-12);
  EXPECT_NEAR(point.z(), std::cos(pose.angle), 1e-12);
}

TEST(WallMotion, RotationAtARate)
{
  WallMotion motion;
  motion.spin = 4.;
  motion.velocity = {0., 0., 1.};
  const WallPose pose = after(motion, 0.3, 7);
  EXPECT_NEAR(pose.angle, 1.2, 1e-14);
  const Vec3 point = dem::WallTransform(motion, pose)(Vec3(1., 0., 0.));
  EXPECT_NEAR((point - Vec3(std::cos(1.2), std::sin(1.2), 0.3)).norm(), 0.,
              1e-12);
}
