#pragma once

#include "report/chart.h"
#include "report/run_data.h"

#include <span>
#include <vector>

namespace spall
{
/// What the progress of a test is drawn over.
struct ChartPath
{
  const char *column, *label;
  double factor = 1.; ///< unit of the column in units of the label
};

/// A column of the history that is drawn over the path.
struct PathQuantity
{
  const char *id;
  ReportSection section;
  const char *column, *label;
  const char *caption;
  double factor = 1.; ///< unit of the column in units of the label
};

Chart path_chart(std::span<const RunData> runs, const ChartPath &path,
                 const PathQuantity &quantity);

/// The forces of the particles on the walls of a scene, a chart for each run
/// and component. Columns are NAME_force_x_N and so on.
std::vector<Chart> wall_charts(std::span<const RunData> runs,
                               const ChartPath &path);

/// Work, dissipation and stored energies: a chart for each run.
std::vector<Chart> path_energy_charts(std::span<const RunData> runs,
                                      const ChartPath &path);
} // namespace spall
