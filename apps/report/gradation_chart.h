#pragma once

#include "report/chart.h"
#include "report/run_data.h"

#include <span>

namespace spall
{
/// Whether one of the runs has a gradation.csv.
bool have_gradation(std::span<const RunData> runs);

/// Share of the mass that passes over the diameter, of the particles as drawn
/// and of the table. A note for a run without gradation.csv.
Chart gradation_chart(std::span<const RunData> runs);
} // namespace spall
