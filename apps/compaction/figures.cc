// The report of a vibratory compaction.
#include "case/gravity.h"
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
    PathQuantity{"settlement", ReportSection::response, "settlement_m",
                 "Settlement (mm)",
                 "Settlement of the plate since the start of the vibration.",
                 1e3},
    PathQuantity{"density", ReportSection::response, "density_kg_per_m3",
                 "Density (kg/m³)",
                 "Density of the layer: initial mass of the particles divided "
                 "by the volume below the plate."},
    PathQuantity{"abrasion", ReportSection::breakage, "laa_percent",
                 "Abrasion LAA (%)",
                 "Abrasion LAA: mass lost by breakage divided by the initial "
                 "mass of the particles."},
    PathQuantity{"breakage_count", ReportSection::breakage, "n_events_1",
                 "Breakage events (–)",
                 "Number of breakage events since the start."},
    PathQuantity{"roundness", ReportSection::breakage, "roundness_1",
                 "Roundness Rg (–)",
                 "Roundness of the particles, mean weighted by volume. The "
                 "value 1 is a particle without corners."},
    PathQuantity{"plate_load", ReportSection::boundaries, "plate_load_N",
                 "Load (kN)", "Vertical force of the particles on the plate.",
                 1e-3},
    PathQuantity{"coordination", ReportSection::network,
                 "coordination_number_1", "Coordination number (–)",
                 "Coordination number: mean number of contacts of the "
                 "particles that have at least two."},
    PathQuantity{"contact_force", ReportSection::network,
                 "mean_contact_force_N", "Mean contact force (N)",
                 "Mean normal force of the contacts between particles."}};

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
      .rows = {{ReportSection::specimen,
                "Density of the filling, requested / reached (kg/m³)",
                density_pair},
               number_row(ReportSection::response,
                          "Settlement during seating (mm)",
                          "seating_settlement_m", 1e3, 4),
               number_row(ReportSection::response, "Time of vibration (s)",
                          "vibration_s", 1., 4),
               number_row(ReportSection::response, "Settlement (mm)",
                          "settlement_m", 1e3, 4),
               number_row(ReportSection::response, "Density at the end (kg/m³)",
                          "density_kg_per_m3", 1., 5),
               number_row(ReportSection::breakage, "Abrasion LAA (%)",
                          "laa_percent", 1., 4),
               number_row(ReportSection::boundaries, "Static load (N)",
                          "static_load_N", 1., 5),
               number_row(ReportSection::boundaries, "Force of the exciter (N)",
                          "exciter_force_N", 1., 4),
               number_row(ReportSection::boundaries,
                          "Largest acceleration of the plate (g)",
                          "peak_plate_acceleration_m_per_s2", 1. / gravity, 3)},
      .charts = make_charts};
  return report;
}
} // namespace spall
