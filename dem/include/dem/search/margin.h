#pragma once

#include <cstdint>

namespace dem
{
/// How far beyond contact the lists look. A wide margin lists pairs that do not
/// touch, a narrow one is used up soon: the margin is set, at each rebuild, to
/// where the sum of both costs is least, from what the last lists have shown.
/// Only counts of steps and contacts enter, never a clock: runs repeat.
struct SearchMargin
{
  double width = 0.;         ///< of the lists that stand [m]
  double left = 0.;          ///< of it, not yet used up by motion [m]
  std::int64_t built_at = 0; ///< step

  /// The lists are made anew at this step. `first` is the width to begin with,
  /// `n_listed` and `n_touching` are counts of the pairs until now,
  /// `rebuild_cost` is that of a rebuild in steps.
  void renew(double first, std::int64_t step, std::int64_t n_listed,
             std::int64_t n_touching, double rebuild_cost);
};
} // namespace dem
