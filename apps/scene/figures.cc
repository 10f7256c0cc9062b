// The report of a scene.
#include "report/kind_report.h"
#include "report/path_charts.h"
#include "scene/kind.h"

#include <array>

namespace spall
{
namespace
{
constexpr ChartPath over_time{"time_s", "Time (s)", 1.};

constexpr std::array quantities = {
    PathQuantity{"height", ReportSection::response, "centre_of_mass_z_m",
                 "Centre of mass, z (mm)",
                 "Height of the centre of mass of all particles.", 1e3},
    PathQuantity{"speed", ReportSection::response, "largest_speed_m_per_s",
                 "Largest speed (m/s)", "Speed of the fastest particle."},
    PathQuantity{"contacts", ReportSection::network, "n_contacts_1",
                 "Contacts between particles (–)",
                 "Number of contacts between particles at each time."},
    PathQuantity{"contact_force", ReportSection::network,
                 "mean_contact_force_N", "Mean contact force (N)",
                 "Mean normal force of the contacts between particles."},
    PathQuantity{"breakage_count", ReportSection::breakage, "n_events_1",
                 "Breakage events (–)",
                 "Number of breakage events since the start."}};

std::vector<Chart> make_charts(std::span<const RunData> runs)
{
  std::vector<Chart> charts;
  for (const PathQuantity &quantity : quantities)
    charts.push_back(path_chart(runs, over_time, quantity));
  for (const Chart &chart : wall_charts(runs, over_time))
    charts.push_back(chart);
  for (const Chart &chart : path_energy_charts(runs, over_time))
    charts.push_back(chart);
  return charts;
}
} // namespace

const KindReport &scene_report()
{
  static const KindReport report = {
      .headlines = {{"Simulated time", " s",
                     [](const RunData &run) { return last(run, "time_s"); }},
                    {.name = "Contacts between particles",
                     .unit = "",
                     .value = [](const RunData &run)
                     { return last(run, "n_contacts_1"); },
                     .is_count = true},
                    {.name = "Breakage events",
                     .unit = "",
                     .value = [](const RunData &run)
                     { return last(run, "n_events_1"); },
                     .is_count = true}},
      .rows = {number_row(ReportSection::response, "Simulated time (s)",
                          "time_s", 1., 4),
               number_row(ReportSection::energy, "Kinetic energy (J)",
                          "kinetic_energy_J", 1., 4)},
      .charts = make_charts};
  return report;
}
} // namespace spall
