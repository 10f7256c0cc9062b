#include "run/thread_plan.h"

#include <algorithm>
#include <cstdio>
#include <utility>

namespace spall
{
namespace
{
/// A candidate has so many steps over so long a time, or if steps are long, at
/// least so many steps over the longer time.
constexpr int enough_steps = 100, least_steps = 5;
constexpr double enough_time = 0.05, longest_trial = 0.3; // [s]
/// Another number than the one in use must be faster by this factor [-].
constexpr double worth_a_change = 1.05;
/// Steps on several threads are slow from this multiple of one thread on [-].
constexpr double slow = 1.1;
/// Time between rounds over the time that a round cost [-], and its bounds [s].
constexpr double rest_per_cost = 40., shortest_rest = 1., longest_rest = 60.;
constexpr double silence = 60.; // of the log after a line [s]
} // namespace

ThreadPlan::ThreadPlan(std::vector<int> thread_numbers)
    : numbers(std::move(thread_numbers)), kept(numbers.size() - 1)
{
  if (numbers.size() > 1)
    begin_round();
}

void ThreadPlan::begin_round()
{
  waiting.clear();
  for (std::size_t k = numbers.size(); k-- > 1;)
    if (is_first_round || (k + 1 >= kept && k <= kept + 1))
      waiting.push_back(k);
  is_in_round = true;
  current = fastest = 0;
  present = best = Measured{};
  lost = 0.;
}

void ThreadPlan::step_took(double seconds)
{
  until_note -= seconds;
  if (numbers.size() == 1)
    return;
  present.seconds += seconds;
  ++present.n_steps;
  until_round -= seconds;
  // A candidate that needs more time than the best has lost before its end.
  const bool is_lost = is_in_round && best.n_steps > 0 &&
                       present.seconds > best.seconds &&
                       present.n_steps <= best.n_steps;
  if (is_in_round && (is_lost || is_measured()))
    try_next();
  else if (!is_in_round && (until_round <= 0. || is_slow_for_several()))
    begin_round();
  else if (!is_in_round && is_measured())
    present = Measured{};
}

bool ThreadPlan::is_measured() const
{
  return (present.n_steps >= enough_steps && present.seconds >= enough_time) ||
         (present.n_steps >= least_steps && present.seconds >= longest_trial);
}

bool ThreadPlan::is_slow_for_several() const
{
  const int steps = is_measured() ? present.n_steps
                                  : std::max(present.n_steps, single.n_steps);
  return current > 0 && present.seconds > slow * steps * single.per_step();
}

void ThreadPlan::try_next()
{
  if (current == 0)
    single = present;
  // The number in use has the better of small differences.
  const double handicap = is_first_round    ? 1.
                          : current == kept ? 1. / worth_a_change
                          : fastest == kept ? worth_a_change
                                            : 1.;
  if (best.n_steps == 0 || handicap * present.per_step() < best.per_step())
  {
    lost += best.seconds;
    best = present;
    fastest = current;
  }
  else
    lost += present.seconds;
  present = Measured{};
  if (waiting.empty())
    return end_round();
  current = waiting.back();
  waiting.pop_back();
}

void ThreadPlan::end_round()
{
  const std::size_t before = kept;
  current = kept = fastest;
  is_in_round = is_first_round = false;
  until_round = std::clamp(rest_per_cost * lost, shortest_rest, longest_rest);
  if (kept != before)
    note_change(before);
}

void ThreadPlan::note_change(std::size_t before)
{
  if (until_note > 0.)
    return;
  until_note = silence;
  char line[160];
  if (kept < before)
    std::snprintf(
        line, sizeof line,
        "threads: %d instead of %d, which are slower now: the machine "
        "is busy or the specimen small",
        numbers[kept], numbers[before]);
  else
    std::snprintf(line, sizeof line,
                  "threads: %d instead of %d, %.2g times as fast as one thread",
                  numbers[kept], numbers[before],
                  single.per_step() / best.per_step());
  note = line;
}

std::string ThreadPlan::take_note()
{
  return std::exchange(note, {});
}
} // namespace spall
