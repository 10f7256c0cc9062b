#pragma once

#include "study/levels.h"

#include <optional>

namespace spall
{
/// One value of a key against the first one of its series, for one outcome.
struct Difference
{
  std::size_t outcome; ///< index in Study::outcomes
  Cut cut;
  Level level;
  bool is_first;
  double first;        ///< mean of the first value, in the unit of the outcome
  Estimate over_seeds; ///< of cases with the same seed

  /// Over the first value [-]; none where that is round-off of zero.
  std::optional<double> share() const;
};

/// Differences of all outcomes over a key, in the order of the tables.
std::vector<Difference> differences_of(const StudyData &data, std::size_t key);

/// A share in per cent with its sign.
std::string with_sign(double share);
} // namespace spall
