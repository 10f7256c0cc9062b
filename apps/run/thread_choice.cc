#include "run/thread_choice.h"

#include <algorithm>
#include <omp.h>

namespace spall
{
std::vector<int> thread_candidates(int most)
{
  const int last = most > 0 ? most : omp_get_num_procs();
  std::vector<int> candidates;
  for (int n = 1; n < 2 * last; n *= 2)
    candidates.push_back(std::min(n, last));
  return candidates;
}

ThreadChoice::ThreadChoice(int most) : plan(thread_candidates(most)) {}

void ThreadChoice::before_step()
{
  if (omp_get_max_threads() != plan.threads())
    omp_set_num_threads(plan.threads());
  started = Clock::now();
}

void ThreadChoice::after_step()
{
  plan.step_took(std::chrono::duration<double>(Clock::now() - started).count());
}
} // namespace spall
