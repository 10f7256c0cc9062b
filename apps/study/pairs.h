#pragma once

#include "study/estimate.h"
#include "study/levels.h"

#include <functional>
#include <map>
#include <string>

namespace spall
{
/// One value per seed.
using SeedValues = std::map<std::string, double>;

/// The mean over the cases of each seed.
SeedValues seed_means(const StudyData &data, const Cut &cut,
                      std::size_t outcome);

/// Outcome at one value of the key of the cut minus that at another with all
/// else the same: the mean over the pairs of each seed. What seeds have in
/// common cancels.
SeedValues paired_differences(const StudyData &data, const Cut &cut,
                              std::size_t outcome, const std::string &from,
                              const std::string &to);

/// of(one, other) of the seeds that both have.
SeedValues combined(const SeedValues &one, const SeedValues &other,
                    const std::function<double(double, double)> &of);

/// Over the seeds.
Estimate estimate_of(const SeedValues &values);
} // namespace spall
