#pragma once

#include <dem/search/near_pairs.h>

namespace dem
{
/// Two bodies that may touch, stone before stone, plane, or part of a drum.
struct WatchedPair
{
  PairKey key;
  /// Travel of both together up to which no place but the listed ones can come
  /// into contact [m].
  double due = 0.;
  double margin = 0.; ///< of the last search [m]
  /// Between the hulls of two stones when last looked at, body frame of the
  /// first; zero: not known [-]
  Vec3 between = Vec3::Zero();
};

/// Stones against walls: the stones have got other numbers.
void renumber_watched(const std::vector<std::int32_t> &place,
                      std::vector<WatchedPair> &walls);
} // namespace dem
