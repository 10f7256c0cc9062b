#pragma once

#include <dem/neighbor/near_pairs.h>

namespace dem
{
/// Two bodies that may touch, particle before particle, plane, or part of a
/// drum.
struct CandidatePair
{
  PairKey key;
  /// Path length of both together up to which no contact point but the listed
  /// ones can come into contact [m].
  double due = 0.;
  double skin = 0.; ///< of the last search [m]
  /// Between the hulls of two particles at the last check, body frame of the
  /// first; zero: not known [-]
  Vec3 between = Vec3::Zero();
};

/// Particles against walls: the particles have got other numbers.
void renumber_candidates(const std::vector<std::int32_t> &new_row,
                         std::vector<CandidatePair> &walls);
} // namespace dem
