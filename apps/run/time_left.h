#pragma once

#include <deque>
#include <limits>
#include <string>

namespace spall
{
/// What is left of a run, by how its share grew over the last half of the time
/// so far, since it last stood still.
class TimeLeft
{
public:
  /// `now` [s] since the start, `share` of the whole that is done by then;
  /// NaN where nothing has grown yet [s].
  double after(double now, double share);

private:
  struct Point
  {
    double time, share;
  };
  std::deque<Point> seen; ///< over the last half of the time
};

/// When a packing will be at rest: its unbalanced force ratio falls by like
/// factors in like times.
class RestTime
{
public:
  explicit RestTime(double target_ratio) : target(target_ratio) {}

  /// `now` [s] since the start, `ratio` > 0 then; NaN where it has not fallen
  /// yet [s].
  double after(double now, double ratio);

private:
  double target, first = 0., least = 0.;
  double end = std::numeric_limits<double>::quiet_NaN(); ///< since the start
  TimeLeft left;
};

/// Minutes and seconds, "12:05".
std::string in_minutes(double seconds);
} // namespace spall
