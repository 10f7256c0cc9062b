#pragma once

#include "study/levels.h"

namespace spall
{
/// One value per seed, the mean over its cases.
std::vector<double> seed_means(const StudyData &data, const Cut &cut,
                               std::size_t outcome);

/// Outcome at one value of the key of the cut minus that at another with all
/// else the same: one value per seed, the mean over its pairs. What seeds have
/// in common cancels.
std::vector<double> paired_differences(const StudyData &data, const Cut &cut,
                                       std::size_t outcome,
                                       const std::string &from,
                                       const std::string &to);
} // namespace spall
