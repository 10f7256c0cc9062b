// The report of a vibratory compaction.
#include "compaction/kind.h"
#include "report/kind_report.h"
#include "report/path_charts.h"
#include "report/roundness_chart.h"

#include <array>

namespace spall
{
namespace
{
constexpr ChartPath vibration{"vibration_s", "Time of vibration (s)", 1.};

constexpr std::array quantities = {
    PathQuantity{"settlement", "settlement_m", "Settlement (mm)",
                 "Settlement of the plate since the vibration began.", 1e3},
    PathQuantity{
        "density", "density_kg_per_m3", "Density (kg/m³)",
        "Mass of the particles as filled over the volume under the plate."},
    PathQuantity{"abrasion", "laa_percent", "Abrasion LAA (%)",
                 "Mass that the particles have lost over their initial mass."},
    PathQuantity{"breakage_count", "n_events_1", "Breakage events (–)",
                 "Number of breakage events so far."},
    PathQuantity{"roundness", "roundness_1", "Roundness Rg (–)",
                 "Mean roundness of the particles, by volume."},
    PathQuantity{"plate_load", "plate_load_N", "Load (kN)",
                 "Force of the particles on the plate.", 1e-3},
    PathQuantity{"coordination", "coordination_number_1",
                 "Coordination number (–)",
                 "Contacts per particle that has at least two."},
    PathQuantity{"contact_force", "mean_contact_force_N",
                 "Mean contact force (N)",
                 "Mean contact force between particles."}};

std::vector<Chart> make_charts(std::span<const RunData> runs)
{
  std::vector<Chart> charts;
  for (const PathQuantity &quantity : quantities)
    charts.push_back(path_chart(runs, vibration, quantity));
  charts.insert(charts.begin() + 5, roundness_chart(runs));
  for (const Chart &chart : wall_charts(runs, vibration))
    charts.push_back(chart);
  for (const Chart &chart : path_energy_charts(runs, vibration))
    charts.push_back(chart);
  return charts;
}

std::string density_pair(const RunData &run)
{
  const auto filling = run.summary.find("filling");
  return filling == run.summary.end()
             ? "–"
             : number_text_of(*filling, "density_asked_kg_per_m3", 1., 4) +
                   " / " +
                   number_text_of(*filling, "density_reached_kg_per_m3", 1., 4);
}
} // namespace

const KindReport &compaction_report()
{
  static const KindReport report = {
      .headlines = {{"Settlement", " mm",
                     [](const RunData &run)
                     { return 1e3 * last(run, "settlement_m"); }},
                    {"Density", " kg/m³",
                     [](const RunData &run)
                     { return last(run, "density_kg_per_m3"); }},
                    {"Abrasion LAA", " %", abrasion_percent}},
      .rows = {{"Density asked / reached (kg/m³)", density_pair},
               number_row("Settlement while seated (mm)",
                          "seating_settlement_m", 1e3, 4),
               number_row("Time of vibration (s)", "vibration_s", 1., 4),
               number_row("Settlement (mm)", "settlement_m", 1e3, 4),
               number_row("Density at the end (kg/m³)", "density_kg_per_m3", 1.,
                          5),
               number_row("Abrasion LAA (%)", "laa_percent", 1., 4),
               number_row("Static load (N)", "static_load_N", 1., 5),
               number_row("Force of the exciter (N)", "exciter_force_N", 1.,
                          4)},
      .charts = make_charts};
  return report;
}
} // namespace spall
