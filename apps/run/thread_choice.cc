#include "run/thread_choice.h"

#include <algorithm>
#include <cstdlib>
#include <omp.h>
#include <unistd.h>

namespace spall
{
namespace
{
/// Cores that this process may use. Ranks of one machine that mpirun has not
/// bound to cores share all of them.
int own_cores()
{
  const int usable = omp_get_num_procs();
  const char *text = std::getenv("OMPI_COMM_WORLD_LOCAL_SIZE");
  const int n_ranks = text ? std::atoi(text) : 1;
  if (n_ranks <= 1)
    return usable;
  const auto all = static_cast<int>(sysconf(_SC_NPROCESSORS_ONLN));
  return std::clamp(all / n_ranks, 1, usable);
}
} // namespace

std::vector<int> thread_candidates(int most)
{
  const int last = most > 0 ? most : own_cores();
  std::vector<int> candidates;
  for (int n = 1; n < 2 * last; n *= 2)
    candidates.push_back(std::min(n, last));
  return candidates;
}

ThreadChoice::ThreadChoice(int most) : plan(thread_candidates(most)) {}

void ThreadChoice::before_step(const dem::Engine &engine)
{
  if (omp_get_max_threads() != plan.threads())
    omp_set_num_threads(plan.threads());
  searched = engine.clock().search;
  started = Clock::now();
}

void ThreadChoice::after_step(const dem::Engine &engine)
{
  const std::chrono::duration<double> all = Clock::now() - started;
  plan.step_took(all.count() - (engine.clock().search - searched));
}
} // namespace spall
