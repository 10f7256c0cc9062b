#pragma once

#include "study/pairs.h"

namespace spall
{
/// What one value of a key costs and how far it is from the reference.
struct PricedLevel
{
  std::size_t key = 0;
  std::string value;
  double cost = 0.;             ///< over that of the reference [-]
  std::vector<Estimate> errors; ///< by outcome, in pairs with the same seed
  /// Largest mean error of any outcome over the spread of the reference [-].
  double worst = 0.;
  bool is_on_front = false; ///< nothing else is cheaper and nearer
  /// The cheapest of its key, the reference among them, with all errors below
  /// half the spread.
  bool is_cheapest_fine = false;
};

/// Spread of the reference over the seeds, by outcome: standard deviation.
std::vector<double> reference_spread(const StudyData &data);

/// Every value of every key that is not that of the reference; the cost is
/// judged by itself and has no error. Empty without a reference.
std::vector<PricedLevel> price_levels(const StudyData &data);
} // namespace spall
