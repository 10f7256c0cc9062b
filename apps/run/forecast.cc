#include "run/forecast.h"

#include "run/thread_choice.h"

#include <algorithm>
#include <chrono>
#include <limits>
#include <omp.h>

namespace spall
{
namespace
{
constexpr double frozen = 1e-15; // step [s]: nothing moves
constexpr int n_steps = 200;

template <class Step>
double mean_cost(const Step &step)
{
  const auto start = std::chrono::steady_clock::now();
  for (int k = 0; k < n_steps; ++k)
    step();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start)
             .count() /
         n_steps;
}
} // namespace

double still_step_cost(dem::Engine &engine, int threads)
{
  engine.advance_unseen(frozen); // makes the lists
  double least = std::numeric_limits<double>::infinity();
  for (const int n : thread_candidates(threads))
  {
    omp_set_num_threads(n);
    least = std::min(least, mean_cost([&] { engine.advance_unseen(frozen); }));
  }
  return least;
}

double still_step_cost(fem::Membrane &membrane)
{
  const std::vector<Eigen::Vector3d> load(membrane.n_nodes(),
                                          Eigen::Vector3d::Zero());
  return mean_cost(
      [&]
      {
        membrane.begin_step(frozen);
        membrane.end_step(load, frozen);
      });
}
} // namespace spall
