#pragma once

#include "report/chart.h"
#include "report/run_data.h"

#include <span>
#include <vector>

namespace spall
{
/// The charts of one run, or of several runs in the same axes. A chart without
/// curves lists in its notes what was missing.
std::vector<Chart> make_charts(std::span<const RunData> runs);
} // namespace spall
