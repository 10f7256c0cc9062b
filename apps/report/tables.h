#pragma once

#include "report/run_data.h"
#include "report/section.h"

#include <span>
#include <string>

namespace spall
{
/// The three numbers that matter, as an HTML element: large for one run, a
/// column per run for several.
std::string headline(std::span<const RunData> runs);

/// The rows of a section: a column per run. Empty without any value.
std::string summary_table(std::span<const RunData> runs, ReportSection section);

/// Seconds and shares of the phases with a bar; empty if no run has them.
std::string wall_clock(std::span<const RunData> runs);
} // namespace spall
