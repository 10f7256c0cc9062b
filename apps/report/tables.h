#pragma once

#include "report/run_data.h"

#include <span>
#include <string>

namespace spall
{
/// The three numbers that matter, as an HTML element: large for one run, a
/// column per run for several.
std::string headline(std::span<const RunData> runs);

/// Specimen, preparation, result and accuracy: a column per run.
std::string summary_table(std::span<const RunData> runs);

/// Seconds and shares of the phases with a bar.
std::string wall_clock(std::span<const RunData> runs);
} // namespace spall
