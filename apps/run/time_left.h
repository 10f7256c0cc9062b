#pragma once

#include <deque>
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

/// Minutes and seconds, "12:05".
std::string in_minutes(double seconds);
} // namespace spall
