#include "report/roundness_chart.h"

#include "report/figure_parts.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <map>

namespace spall
{
namespace
{
/// roundness_50s.csv and so on, by their times [s].
std::map<double, Table> roundness_tables(const std::string &folder)
{
  namespace fs = std::filesystem;
  std::map<double, Table> tables;
  std::error_code status;
  const std::string start = "roundness_";
  for (const fs::directory_entry &entry :
       fs::directory_iterator(folder, status))
    if (const std::string name = entry.path().filename().string();
        name.starts_with(start) && name.ends_with("s.csv"))
      tables[std::atof(name.c_str() + start.size())] =
          read_table(entry.path().string());
  return tables;
}

/// Share of the particles whose roundness is smaller.
void add_distribution(const Table &table, Curve curve, Chart &chart)
{
  const Column *roundness = table.find("roundness_1");
  if (!roundness || roundness->empty())
    return;
  curve.x = *roundness;
  std::ranges::sort(curve.x);
  for (std::size_t k = 0; k < curve.x.size(); ++k)
    curve.y.push_back(100. * static_cast<double>(k + 1) /
                      static_cast<double>(curve.x.size()));
  chart.curves.push_back(curve);
}
} // namespace

Chart roundness_chart(std::span<const RunData> runs)
{
  Chart chart{"roundness_distribution", ReportSection::breakage,
              "Distribution of the roundness: share of the particles, by "
              "number, whose roundness is smaller.",
              "Roundness Rg (–)", "Particles below (%)"};
  for (std::size_t k = 0; k < runs.size(); ++k)
  {
    const auto tables = roundness_tables(runs[k].folder);
    if (tables.empty())
      chart.notes.push_back(runs[k].name + ": there is no roundness_*s.csv.");
    else if (runs.size() > 1)
      add_distribution(tables.rbegin()->second, run_curve(runs, k), chart);
    else
      for (const auto &[time, table] : tables)
      {
        char name[32];
        std::snprintf(name, sizeof name, "%.6g s", time);
        Curve curve;
        curve.name = name;
        curve.colour = palette_colour(chart.curves.size());
        curve.dash = palette_dash(chart.curves.size());
        add_distribution(table, curve, chart);
      }
  }
  return chart;
}
} // namespace spall
