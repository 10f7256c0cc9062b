// The report of a Los Angeles test.
#include "los_angeles/kind.h"
#include "report/figure_parts.h"
#include "report/kind_report.h"
#include "report/path_charts.h"
#include "report/roundness_chart.h"

#include <array>

namespace spall
{
namespace
{
constexpr ChartPath drum{"turn_1", "Turns (–)", 1.};

constexpr std::array drum_quantities = {
    PathQuantity{"abrasion", ReportSection::breakage, "laa_percent",
                 "Abrasion LAA (%)",
                 "Abrasion LAA: mass lost by the particles divided by their "
                 "initial mass. The steel balls are excluded."},
    PathQuantity{"breakage_count", ReportSection::breakage, "n_events_1",
                 "Breakage events (–)",
                 "Number of breakage events since the start."},
    PathQuantity{"roundness", ReportSection::breakage, "roundness_1",
                 "Roundness Rg (–)",
                 "Roundness of the particles, mean weighted by volume. The "
                 "value 1 is a particle without corners."},
    PathQuantity{"torque", ReportSection::boundaries, "torque_Nm",
                 "Torque (N m)",
                 "Torque of the charge on the drum about the drum axis."},
    PathQuantity{
        "contacts", ReportSection::network, "n_contacts_1", "Contacts (–)",
        "Number of contacts between particles and balls at each time."}};

/// Loss per turn between the rows of the history, in ten parts of the run.
Chart rate_chart(std::span<const RunData> runs)
{
  Chart chart{"abrasion_rate", ReportSection::breakage,
              "Rate of the abrasion: mass loss per turn of the drum, mean over "
              "each tenth of the run.",
              drum.label, "LAA per turn (%)"};
  for (std::size_t k = 0; k < runs.size(); ++k)
  {
    const Table &table = runs[k].loading;
    const Column *turn = find_or_note(table, drum.column, runs[k], chart);
    const Column *laa = find_or_note(table, "laa_percent", runs[k], chart);
    if (!turn || !laa || turn->size() < 11)
      continue;
    Curve curve = run_curve(runs, k);
    curve.marker = Marker::dot;
    const std::size_t n = turn->size() - 1;
    for (std::size_t part = 0; part < 10; ++part)
    {
      const std::size_t from = part * n / 10, to = (part + 1) * n / 10;
      const double turned = (*turn)[to] - (*turn)[from];
      if (turned <= 0.)
        continue;
      curve.x.push_back(0.5 * ((*turn)[to] + (*turn)[from]));
      curve.y.push_back(((*laa)[to] - (*laa)[from]) / turned);
    }
    chart.curves.push_back(curve);
  }
  return chart;
}

std::vector<Chart> make_charts(std::span<const RunData> runs)
{
  std::vector<Chart> charts;
  for (const PathQuantity &quantity : drum_quantities)
    charts.push_back(path_chart(runs, drum, quantity));
  charts.push_back(rate_chart(runs));
  charts.push_back(roundness_chart(runs));
  for (const Chart &chart : wall_charts(runs, drum))
    charts.push_back(chart);
  for (const Chart &chart : path_energy_charts(runs, drum))
    charts.push_back(chart);
  return charts;
}
} // namespace

const KindReport &los_angeles_report()
{
  static const KindReport report = {
      .headlines = {{"Abrasion LAA", " %", abrasion_percent},
                    {"Turns", "",
                     [](const RunData &run) { return last(run, "turn_1"); }},
                    {.name = "Breakage events",
                     .unit = "",
                     .value = [](const RunData &run)
                     { return last(run, "n_events_1"); },
                     .is_count = true}},
      .rows = {number_row(ReportSection::response, "Turns (–)", "turns_1", 1.,
                          5),
               number_row(ReportSection::breakage, "Abrasion LAA (%)",
                          "laa_percent", 1., 4),
               number_row(ReportSection::breakage, "Mass lost (g)",
                          "lost_mass_kg", 1e3, 4)},
      .charts = make_charts};
  return report;
}
} // namespace spall
