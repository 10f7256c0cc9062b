// The report of a single particle.
#include "report/figure_parts.h"
#include "report/kind_report.h"
#include "report/path_charts.h"
#include "single_particle/kind.h"

#include <array>

namespace spall
{
namespace
{
constexpr ChartPath press{"displacement_m", "Displacement (mm)", 1e3};

constexpr std::array press_quantities = {
    PathQuantity{"breakage_count", ReportSection::breakage, "n_events_1",
                 "Breakage events (–)",
                 "Number of breakage events Nb since the start."},
    PathQuantity{
        "abrasion", ReportSection::breakage, "laa_percent", "Mass lost (%)",
        "Mass lost by breakage divided by the initial mass of the particle."}};
/// Points of the breakage events: mode I as dots, mode II as rings.
void add_events(const RunData &run, Chart &chart)
{
  const Column *x = run.events.find(press.column),
               *force = run.events.find("force_before_N"),
               *mode = run.events.find("mode_1");
  if (!x || !force || !mode)
    return;
  for (const int which : {1, 2})
  {
    Curve points;
    points.name = which == 1 ? "cumulative (I)" : "instantaneous (II)";
    points.colour = palette_colour(which == 1 ? 1 : 3);
    points.line_width = 0.;
    points.marker = which == 1 ? Marker::dot : Marker::ring;
    for (std::size_t e = 0; e < x->size(); ++e)
      if (static_cast<int>((*mode)[e]) == which)
      {
        points.x.push_back(press.factor * (*x)[e]);
        points.y.push_back((*force)[e]);
      }
    if (!points.x.empty())
      chart.curves.push_back(points);
  }
}

Chart force_chart(std::span<const RunData> runs)
{
  Chart chart = path_chart(
      runs, press,
      {"force_displacement", ReportSection::response, "force_N", "Force (N)",
       "Force on the upper platen and displacement of this platen. Each drop "
       "is "
       "a breakage event. Markers: contact force just before the event, by the "
       "mode of the breakage criterion."});
  if (runs.size() == 1)
  {
    for (Curve &curve : chart.curves)
      curve.csv_name = "force on the platen";
    add_events(runs[0], chart);
  }
  return chart;
}

std::vector<Chart> make_charts(std::span<const RunData> runs)
{
  std::vector<Chart> charts = {force_chart(runs)};
  for (const PathQuantity &quantity : press_quantities)
    charts.push_back(path_chart(runs, press, quantity));
  for (const Chart &chart : path_energy_charts(runs, press))
    charts.push_back(chart);
  return charts;
}
} // namespace

const KindReport &single_particle_report()
{
  static const KindReport report = {
      .headlines = {{"First event", " N",
                     [](const RunData &run)
                     { return number(run.summary, "first_event_force_N"); }},
                    {"Largest force", " N",
                     [](const RunData &run)
                     { return number(run.summary, "peak_force_N"); }},
                    {"Breakage events", "",
                     [](const RunData &run)
                     { return last(run, "n_events_1"); }}},
      .rows = {number_row(ReportSection::response, "Displacement (mm)",
                          "displacement_m", 1e3, 4),
               number_row(ReportSection::breakage,
                          "Force of the first event (N)", "first_event_force_N",
                          1., 4),
               number_row(ReportSection::response, "Largest force (N)",
                          "peak_force_N", 1., 4),
               number_row(ReportSection::breakage,
                          "Nominal stress F/d² of the first event (MPa)",
                          "first_event_nominal_stress_Pa", 1e-6, 4),
               number_row(ReportSection::response,
                          "Largest nominal stress F/d² (MPa)",
                          "peak_nominal_stress_Pa", 1e-6, 4)},
      .charts = make_charts};
  return report;
}
} // namespace spall
