#pragma once

#include "fetch_ahead.h"
#include "followed_wall_simd.h"
#include "surface_simd.h"

/// The loops over contacts of one law, for units that are compiled once per
/// instruction set.
namespace dem::kernel
{
namespace
{
constexpr int n_parts = lane_block / n_lanes;

/// All lanes together: exact, in any order.
Dissipation sum_of(const Losses<Simd> &lost)
{
  return {stdx::reduce(lost.friction), stdx::reduce(lost.rolling),
          stdx::reduce(lost.damping), stdx::reduce(lost.non_conservative_work)};
}

template <auto advance>
void run_range(const Task &task, std::int64_t first, std::int64_t last,
               RangeSum &sum)
{
  const Target target{task.contacts.a[first], sum};
  LaneSums sums;
  for (std::int64_t k = first; k < last; k += lane_block)
  {
    if (task.ahead.n > 0)
      fetch_ahead(task, k, last);
    for (int part = 0; part < n_parts; ++part)
    {
      const std::int64_t from = k + part * n_lanes;
      const std::int64_t n_valid =
          last - from < n_lanes ? last - from : n_lanes;
      if (n_valid > 0)
        advance(task, from, static_cast<int>(n_valid), sums, target);
    }
  }
  sum.lost += sum_of(sums.lost);
  sum.lost_rest += sum_of(sums.lost_rest);
  sum.largest_force = stdx::hmax(sums.largest_force);
}

/// The row of one law in the table of kernels. Laws that attract do so along
/// the branch and on planes: true surfaces follow their contacts from touch on.
template <class Law>
requires NormalLaw<Law, Simd>
constexpr Loops loops_of()
{
  Loops loops{run_range<advance_pairs<Law>>, run_range<advance_walls<Law>>,
              nullptr, nullptr, nullptr};
  if constexpr (!Law::attracts)
  {
    loops.surface_pairs = run_range<advance_surface_pairs<Law>>;
    loops.surface_walls = run_range<advance_surface_walls<Law>>;
    loops.followed_walls = run_range<advance_followed_walls<Law>>;
  }
  return loops;
}
} // namespace
} // namespace dem::kernel
