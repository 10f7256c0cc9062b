#pragma once

#include "report/chart.h"
#include "report/run_data.h"

#include <span>
#include <vector>

namespace spall
{
/// Whether the runs are of one of the kinds of LabTest.
bool are_lab_runs(std::span<const RunData> runs);

/// Charts over displacement or turns, of one run or of several in the same
/// axes. A chart without curves says in its notes what was missing.
std::vector<Chart> make_lab_charts(std::span<const RunData> runs);
} // namespace spall
