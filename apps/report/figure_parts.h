#pragma once

#include "report/chart.h"
#include "report/run_data.h"

#include <span>
#include <string>
#include <vector>

namespace spall
{
using Column = std::vector<double>;

inline constexpr const char *cycle_label = "Cycle N (–)";

/// The charts of the parts of a report; see figures.h.
Chart loop_chart(std::span<const RunData> runs);
std::vector<Chart> energy_charts(std::span<const RunData> runs);
Chart residual_chart(std::span<const RunData> runs);
std::vector<Chart> event_charts(std::span<const RunData> runs);
std::vector<Chart> cycle_charts(std::span<const RunData> runs);
std::vector<Chart> profile_charts(std::span<const RunData> runs);

Column scaled(const Column &values, double factor);
Column picked(const Column &values, const std::vector<std::size_t> &rows);

/// Differences to the first value, which is the start of loading.
Column since_start(const Column &values);

/// Largest absolute value; NaN is left out.
double largest(const Column &values);

/// Null, with a line in the notes, if the run has no such column or no rows.
const Column *find_or_note(const Table &table, const std::string &column,
                           const RunData &run, Chart &chart);

/// An empty curve in the style of run k, named if there are several runs.
Curve run_curve(std::span<const RunData> runs, std::size_t k);

/// An empty chart over cycles for run k alone; named so among several runs.
Chart chart_of_run(std::span<const RunData> runs, std::size_t k, Chart chart);
} // namespace spall
