#include <dem/boundary/wall_motion.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace dem
{
namespace
{
Vec3 table_at(const WallMotion &motion, double time)
{
  const auto &times = motion.table_time;
  if (times.empty())
    return Vec3::Zero();
  const auto after = std::ranges::upper_bound(times, time);
  if (after == times.begin())
    return motion.table_shift.front();
  if (after == times.end())
    return motion.table_shift.back();
  const auto k = static_cast<std::size_t>(after - times.begin());
  const double share = (time - times[k - 1]) / (times[k] - times[k - 1]);
  return (1. - share) * motion.table_shift[k - 1] +
         share * motion.table_shift[k];
}
} // namespace

Vec3 prescribed_shift(const WallMotion &motion, double time)
{
  const double phase = 2. * std::numbers::pi * motion.frequency * time;
  return time * motion.velocity + std::sin(phase) * motion.amplitude +
         table_at(motion, time);
}

Vec3 driving_force(const WallMotion &motion, double time)
{
  const double phase = 2. * std::numbers::pi * motion.frequency * time;
  return motion.force + 0.5 * (1. - std::cos(phase)) * motion.force_amplitude;
}

WallPose advanced(const WallMotion &motion, const WallPose &pose,
                  const WallLoad &load, double time_step)
{
  WallPose next = pose;
  next.time += time_step;
  const double moving = next.time - motion.start;
  if (moving <= 0.)
    return next;
  const Vec3 shift = prescribed_shift(motion, moving);
  const Vec3 force =
      driving_force(motion, std::max(0., moving - time_step)) + load.force;
  for (Eigen::Index d = 0; d < 3; ++d)
    if (motion.free[d] != 0.)
    {
      next.velocity[d] += time_step * force[d] / motion.mass;
      if (motion.largest_speed > 0.)
        next.velocity[d] = std::clamp(next.velocity[d], -motion.largest_speed,
                                      motion.largest_speed);
      next.shift[d] += time_step * next.velocity[d];
    }
    else
    {
      next.shift[d] = shift[d];
      next.velocity[d] = (shift[d] - pose.shift[d]) / time_step;
    }
  if (motion.inertia > 0.)
  {
    next.spin += time_step * (motion.torque + load.moment.dot(motion.axis)) /
                 motion.inertia;
    next.angle += time_step * next.spin;
  }
  else
  {
    next.angle = motion.spin * moving;
    next.spin = (next.angle - pose.angle) / time_step;
  }
  return next;
}

WallTransform::WallTransform(const WallMotion &motion, const WallPose &pose)
    : is_turned(pose.angle != 0.),
      turn(Eigen::AngleAxisd(pose.angle, motion.axis).toRotationMatrix()),
      centre(motion.centre), shift(pose.shift)
{
}
} // namespace dem
