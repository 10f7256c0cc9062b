#pragma once

#include <cstdint>

namespace dem
{
/// How far beyond contact the lists look. A wide skin lists pairs that do not
/// touch, a narrow one is used up soon: the skin is set, at each rebuild, to
/// where the sum of both costs is least, from what the last lists have shown.
/// Only counts of steps and contacts enter, never a clock: runs repeat.
struct SkinWidth
{
  double given = 0.;         ///< instead of what costs least; 0: none [m]
  double width = 0.;         ///< of the lists that stand [m]
  double left = 0.;          ///< of it, not yet used up by motion [m]
  double open_pairs = 0.;    ///< per touching one and metre of width [1/m]
  std::int64_t built_at = 0; ///< step

  /// What lists cost.
  struct Cost
  {
    double rebuild = 0.;   ///< in steps
    double open_pair = 0.; ///< over that of a pair that touches [-]
  };

  /// What the lists of this step look like.
  struct Lists
  {
    std::int64_t step = 0, n_listed = 0, n_touching = 0;
    Cost cost;
  };

  /// The lists will be rebuilt: finds their width. `usual` is
  /// GeometryParameters::usual_skin [m].
  void renew(double usual, const Lists &old);

  /// Whether narrower lists would have paid for a rebuild by now.
  bool is_too_wide(const Lists &now);

private:
  /// Width of least cost at the motion since the last rebuild [m].
  double best_width(const Lists &now) const;
};
} // namespace dem
