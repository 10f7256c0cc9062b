#include "run/step_schedule.h"

#include <algorithm>
#include <cmath>

namespace spall
{
void StepSchedule::begin(double length, double longest_step,
                         std::int64_t intervals)
{
  interval = left = length;
  n_intervals = intervals;
  replan(longest_step);
}

void StepSchedule::replan(double longest_step)
{
  longest = longest_step;
  if (std::isinf(left))
  {
    length_of_step = longest;
    return;
  }
  // A step that is too long by rounding alone is not cut.
  steps_left = std::max<std::int64_t>(
      1, static_cast<std::int64_t>(std::ceil(left / longest - 1e-9)));
  length_of_step = left / static_cast<double>(steps_left);
}

void StepSchedule::count()
{
  if (std::isinf(left))
    return;
  left -= length_of_step;
  if (--steps_left > 0)
    return;
  ++n_intervals;
  left = interval;
  replan(longest);
}
} // namespace spall
