#pragma once

#include "report/chart.h"
#include "report/run_data.h"

#include <span>
#include <vector>

namespace spall
{
/// Whether the run is a vibratory compaction.
bool is_compaction(const RunData &run);

/// Charts over the time of vibration, and the roundness of the particles at the
/// report times; energies are those of every test in steps.
std::vector<Chart> make_compaction_charts(std::span<const RunData> runs);
} // namespace spall
