// Compiled once per instruction set, with SPALL_INSTRUCTION_SET its name.
#include "fetch_ahead.h"
#include "placed_simd.h"
#include "surface_simd.h"

namespace dem::kernel
{
namespace
{
constexpr int n_parts = lane_block / n_lanes;
using BlockLosses = Losses<Simd>[n_parts];

/// What the lanes have lost, place by place in the block.
void sum_losses(const BlockLosses &lost, Dissipation &sum)
{
  for (int part = 0; part < n_parts; ++part)
  {
    SimdTable<4> table;
    table.set(0, {{lost[part].friction, lost[part].rolling, lost[part].damping},
                  lost[part].non_conservative_work});
    for (int lane = 0; lane < n_lanes; ++lane)
    {
      sum.friction += table.value[lane][0];
      sum.rolling += table.value[lane][1];
      sum.damping += table.value[lane][2];
      sum.non_conservative_work += table.value[lane][3];
    }
  }
}

template <auto advance>
void run_range(const Task &task, std::int64_t first, std::int64_t last,
               RangeSum &sum)
{
  const Target target{task.contacts.a[first], sum};
  BlockLosses lost;
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
        advance(task, from, static_cast<int>(n_valid), lost[part], target);
    }
  }
  sum_losses(lost, sum.lost);
}
} // namespace

namespace SPALL_INSTRUCTION_SET
{
extern const Loops loops;
const Loops loops = {run_range<advance_pairs>, run_range<advance_walls>,
                     run_range<advance_surface_pairs>,
                     run_range<advance_surface_walls>,
                     run_range<advance_placed_walls>};
} // namespace SPALL_INSTRUCTION_SET
} // namespace dem::kernel
