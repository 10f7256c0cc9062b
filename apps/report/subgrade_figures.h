#pragma once

#include "report/chart.h"
#include "report/run_data.h"

#include <span>
#include <vector>

namespace spall
{
bool are_subgrade_runs(std::span<const RunData> runs);

/// Charts over the time of the loading, the transfer functions, velocities over
/// height and the settled surface, of one run or of several in the same axes.
std::vector<Chart> make_subgrade_charts(std::span<const RunData> runs);
} // namespace spall
