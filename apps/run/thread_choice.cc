#include "run/thread_choice.h"

#include <algorithm>
#include <omp.h>

namespace spall
{
namespace
{
constexpr int trial_steps = 100, keep_steps = 10000;
} // namespace

std::vector<int> thread_candidates(int fixed)
{
  if (fixed > 0)
    return {fixed};
  std::vector<int> candidates;
  for (int n = 1; n < 2 * omp_get_num_procs(); n *= 2)
    candidates.push_back(std::min(n, omp_get_num_procs()));
  return candidates;
}

ThreadChoice::ThreadChoice(int fixed) : candidates(thread_candidates(fixed))
{
  start_trial(0);
}

void ThreadChoice::start_trial(std::size_t candidate)
{
  trial = candidate;
  steps = 0;
  omp_set_num_threads(candidates[candidate]);
  started = Clock::now();
}

void ThreadChoice::before_step()
{
  if (candidates.size() == 1)
    return;
  ++steps;
  if (trial == candidates.size()) // the best is at work
  {
    if (steps >= keep_steps)
      start_trial(0);
    return;
  }
  const double time =
      std::chrono::duration<double>(Clock::now() - started).count();
  const bool is_late = trial > 0 && time > best_time;
  if (steps < trial_steps && !is_late)
    return;
  if (trial == 0 || !is_late)
  {
    best = trial;
    best_time = time;
  }
  if (trial + 1 < candidates.size())
    return start_trial(trial + 1);
  omp_set_num_threads(candidates[best]);
  trial = candidates.size();
  steps = 0;
}
} // namespace spall
