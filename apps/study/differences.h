#pragma once

#include "study/levels.h"

#include <optional>

namespace spall
{
/// Value of a key that its others are compared with: the first one, or where
/// cases are missing the first of those with the most. Empty if the key has no
/// value.
std::string reference_value(const StudyData &data, std::size_t key);

/// Its words in a title or sentence: "the first value", "the value 20".
std::string reference_words(const StudyData &data, std::size_t key);

/// One value of a key against the reference of its series, for one outcome.
struct Difference
{
  std::size_t outcome; ///< index in Study::outcomes
  Cut cut;
  Level level;
  bool is_reference;
  double reference;    ///< mean of the reference, in the unit of the outcome
  Estimate over_seeds; ///< of cases with the same seed

  /// Over the reference [-]; none where that is round-off of zero.
  std::optional<double> share() const;
};

/// Differences of all outcomes over a key, in the order of the tables; of each
/// series the reference comes first, or its first value where it lacks that.
std::vector<Difference> differences_of(const StudyData &data, std::size_t key);

/// A share in per cent with its sign.
std::string with_sign(double share);
} // namespace spall
