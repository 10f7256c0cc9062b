#include "run/time_left.h"

#include <limits>

namespace spall
{
double TimeLeft::after(double now, double share)
{
  // What stood still before, a preparation, says nothing of the rest.
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
} // namespace spall
