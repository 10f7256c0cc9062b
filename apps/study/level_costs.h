#pragma once

#include "study/pairs.h"

#include <cmath>

namespace spall
{
/// What one value of a key costs and how far it is from the reference.
struct LevelCost
{
  std::size_t key = 0;
  std::string value;
  /// What it is a choice of: its key, or the first key that a variant sets.
  std::string parameter;
  bool is_control = false;   ///< see Study::controls
  std::vector<double> costs; ///< each over that of the reference [-]
  bool saves = false;        ///< the first one is below 1, by its 95 % interval
  std::vector<Estimate> errors; ///< by outcome, in pairs with the same seed
  /// Largest mean error of any outcome over the spread of the reference [-].
  double worst = 0.;
  bool is_on_front = false; ///< nothing else is cheaper and nearer
  /// The cheapest of its parameter that saves, with all errors below half the
  /// spread.
  bool is_cheapest_fine = false;

  double cost() const { return costs.front(); } ///< the one that counts
};

/// Result of the map for the default of one parameter.
struct DefaultCost
{
  std::string parameter;
  std::string default_value;          ///< of the program
  double cost = 1., worst = 0.;       ///< NaN where the map does not have it
  std::string cheapest = "reference"; ///< of those that are fine
  /// The default is fine, and none that is fine costs less by its interval.
  bool is_right = false;

  bool is_measured() const { return std::isfinite(cost); }
};

/// Spread of the reference over the seeds, by outcome: standard deviation.
std::vector<double> reference_spread(const StudyData &data);

/// Of how many cases.
std::ptrdiff_t reference_size(const StudyData &data);

/// Every value of every key that is not that of the reference; costs are
/// judged by themselves and have no error. Empty without a reference.
std::vector<LevelCost> level_costs(const StudyData &data);

/// Of every parameter whose key has a default: not of presets.
std::vector<DefaultCost> default_costs(const StudyData &data,
                                       const std::vector<LevelCost> &map);

/// Whether an outcome of the study is a cost.
bool is_cost(const Study &study, const std::string &outcome);
} // namespace spall
