#include "report/path_charts.h"

#include "report/figure_parts.h"

#include <array>
#include <utility>

namespace spall
{
Chart path_chart(std::span<const RunData> runs, const ChartPath &path,
                 const PathQuantity &quantity)
{
  Chart chart{quantity.id, quantity.section, quantity.caption, path.label,
              quantity.label};
  for (std::size_t k = 0; k < runs.size(); ++k)
  {
    const Table &table = runs[k].loading;
    const Column *x = find_or_note(table, path.column, runs[k], chart);
    const Column *y = find_or_note(table, quantity.column, runs[k], chart);
    if (!x || !y)
      continue;
    Curve curve = run_curve(runs, k);
    curve.x = scaled(*x, path.factor);
    curve.y = scaled(*y, quantity.factor);
    chart.curves.push_back(curve);
  }
  return chart;
}

namespace
{
constexpr std::array energy_terms = {
    std::pair{"external_work_J", "external work"},
    std::pair{"friction_dissipation_J", "friction"},
    std::pair{"damping_dissipation_J", "damping"},
    std::pair{"rolling_dissipation_J", "rolling"},
    std::pair{"elastic_energy_J", "elastic"},
    std::pair{"kinetic_energy_J", "kinetic"},
    std::pair{"breakage_energy_J", "breakage"},
    std::pair{"non_conservative_work_J", "non-conservative work"},
    std::pair{"energy_residual_J", "residual"}};

} // namespace

namespace
{
/// One curve for each wall whose column has this ending.
std::vector<Curve> wall_curves(const RunData &run, const std::string &ending,
                               const std::vector<double> &x)
{
  std::vector<Curve> curves;
  for (std::size_t c = 0; c < run.loading.names.size(); ++c)
    if (const std::string &column = run.loading.names[c];
        column.ends_with(ending))
    {
      Curve curve;
      curve.name = column.substr(0, column.size() - ending.size());
      curve.colour = palette_colour(curves.size());
      curve.dash = palette_dash(curves.size());
      curve.x = x;
      curve.y = run.loading.columns[c];
      curves.push_back(curve);
    }
  return curves;
}
} // namespace

std::vector<Chart> wall_charts(std::span<const RunData> runs,
                               const ChartPath &path)
{
  std::vector<Chart> charts;
  for (std::size_t k = 0; k < runs.size(); ++k)
    for (const std::string axis : {"x", "y", "z"})
    {
      Chart chart = chart_of_run(
          runs, k,
          {"wall_force_" + axis, ReportSection::boundaries,
           "Force of the particles on each wall, component along " + axis +
               "."});
      chart.x_label = path.label;
      chart.y_label = "Force (N)";
      const Column *x =
          find_or_note(runs[k].loading, path.column, runs[k], chart);
      if (x)
        chart.curves = wall_curves(runs[k], "_force_" + axis + "_N",
                                   scaled(*x, path.factor));
      if (!chart.curves.empty())
        charts.push_back(chart);
    }
  return charts;
}

std::vector<Chart> path_energy_charts(std::span<const RunData> runs,
                                      const ChartPath &path)
{
  std::vector<Chart> charts;
  for (std::size_t k = 0; k < runs.size(); ++k)
  {
    Chart chart = chart_of_run(
        runs, k,
        {"energies", ReportSection::energy,
         "External work, dissipation and stored energies since the start of "
         "the run."});
    chart.x_label = path.label;
    chart.y_label = "Energy (J)";
    const Column *x =
        find_or_note(runs[k].loading, path.column, runs[k], chart);
    for (std::size_t t = 0; x && t < energy_terms.size(); ++t)
      if (const Column *y = runs[k].loading.find(energy_terms[t].first))
      {
        Curve curve;
        curve.name = energy_terms[t].second;
        curve.colour = palette_colour(t);
        curve.dash = palette_dash(t);
        curve.x = scaled(*x, path.factor);
        curve.y = *y;
        chart.curves.push_back(curve);
      }
    charts.push_back(chart);
  }
  return charts;
}
} // namespace spall
