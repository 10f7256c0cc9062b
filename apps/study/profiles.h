#pragma once

#include "report/chart.h"
#include "study/study.h"

#include <filesystem>

namespace spall
{
/// Means over the cases of every value of a key, row by row as far as all of
/// them go, with a standard deviation of the outcome here and there; a colour
/// for every value. Other keys of a grid
/// as in the base case. `folder` is that of the study.
Chart profile_chart(const StudyData &data, std::size_t key,
                    const Profile &profile,
                    const std::filesystem::path &folder);
} // namespace spall
