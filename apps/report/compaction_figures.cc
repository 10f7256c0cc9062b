#include "report/compaction_figures.h"

#include "report/figure_parts.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <filesystem>
#include <map>

namespace spall
{
namespace
{
struct Quantity
{
  const char *id, *column, *label, *caption;
  double factor = 1.;
};

constexpr std::array quantities = {
    Quantity{"settlement", "settlement_m", "Settlement (mm)",
             "Settlement of the plate since the vibration began.", 1e3},
    Quantity{"density", "density_kg_per_m3", "Density (kg/m³)",
             "Mass of the stones as filled over the volume under the plate."},
    Quantity{"abrasion", "laa_percent", "Abrasion LAA (%)",
             "Mass that the stones have lost over their initial mass."},
    Quantity{"breakage_count", "n_events_1", "Breakage events (–)",
             "Number of breakage events so far."},
    Quantity{"roundness", "roundness_1", "Roundness Rg (–)",
             "Mean roundness of the stones, by volume."},
    Quantity{"plate_load", "plate_load_N", "Load (kN)",
             "Force of the stones on the plate.", 1e-3},
    Quantity{"coordination", "coordination_number_1", "Coordination number (–)",
             "Contacts per stone that has at least two."},
    Quantity{"contact_force", "mean_contact_force_N", "Mean contact force (N)",
             "Mean contact force between stones."}};

Chart quantity_chart(std::span<const RunData> runs, const Quantity &quantity)
{
  Chart chart{quantity.id, quantity.caption, "Time of vibration (s)",
              quantity.label};
  for (std::size_t k = 0; k < runs.size(); ++k)
  {
    const Table &table = runs[k].loading;
    const Column *x = find_or_note(table, "vibration_s", runs[k], chart);
    const Column *y = find_or_note(table, quantity.column, runs[k], chart);
    if (!x || !y)
      continue;
    Curve curve = run_curve(runs, k);
    curve.x = *x;
    curve.y = scaled(*y, quantity.factor);
    chart.curves.push_back(curve);
  }
  return chart;
}

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

/// Share of the stones whose roundness is smaller.
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

/// All times of one run, or the last of several.
Chart roundness_chart(std::span<const RunData> runs)
{
  Chart chart{"roundness_distribution",
              "Roundness of the stones: share of their number below.",
              "Roundness Rg (–)", "Stones below (%)"};
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
} // namespace

bool is_compaction(const RunData &run)
{
  return run.loading.find("settlement_m") != nullptr;
}

std::vector<Chart> make_compaction_charts(std::span<const RunData> runs)
{
  std::vector<Chart> charts;
  for (const Quantity &quantity : quantities)
    charts.push_back(quantity_chart(runs, quantity));
  charts.insert(charts.begin() + 5, roundness_chart(runs));
  return charts;
}
} // namespace spall
