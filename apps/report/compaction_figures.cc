#include "report/compaction_figures.h"

#include "report/figure_parts.h"
#include "report/roundness_chart.h"

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
    Quantity{
        "density", "density_kg_per_m3", "Density (kg/m³)",
        "Mass of the particles as filled over the volume under the plate."},
    Quantity{"abrasion", "laa_percent", "Abrasion LAA (%)",
             "Mass that the particles have lost over their initial mass."},
    Quantity{"breakage_count", "n_events_1", "Breakage events (–)",
             "Number of breakage events so far."},
    Quantity{"roundness", "roundness_1", "Roundness Rg (–)",
             "Mean roundness of the particles, by volume."},
    Quantity{"plate_load", "plate_load_N", "Load (kN)",
             "Force of the particles on the plate.", 1e-3},
    Quantity{"coordination", "coordination_number_1", "Coordination number (–)",
             "Contacts per particle that has at least two."},
    Quantity{"contact_force", "mean_contact_force_N", "Mean contact force (N)",
             "Mean contact force between particles."}};

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
