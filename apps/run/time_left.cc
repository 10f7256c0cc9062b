#include "run/time_left.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

namespace spall
{
double TimeLeft::after(double now, double share)
{
  // What stood still before, a preparation, is no measure of the rest.
  if (!seen.empty() && seen.back().share >= share)
    seen.clear();
  seen.push_back({now, share});
  while (seen.size() > 2 && now - seen[1].time > 0.5 * now)
    seen.pop_front();
  const Point &first = seen.front();
  const double grown = share - first.share;
  return grown > 0. ? (now - first.time) * (1. - share) / grown
                    : std::numeric_limits<double>::quiet_NaN();
}

double RestTime::after(double now, double ratio)
{
  if (first == 0.)
    first = ratio;
  // Oscillations in between are no measure of the end.
  if (first > target && (least == 0. || ratio < least))
  {
    least = ratio;
    end = now + left.after(now, std::min(1., std::log(first / least) /
                                                 std::log(first / target)));
  }
  return std::max(end - now, 0.); // NaN stays
}

std::string in_minutes(double seconds)
{
  char text[32];
  const long whole = std::lround(seconds);
  std::snprintf(text, sizeof text, "%ld:%02ld", whole / 60, whole % 60);
  return text;
}
} // namespace spall
