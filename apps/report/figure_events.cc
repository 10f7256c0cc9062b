#include "report/figure_parts.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace spall
{
namespace
{
/// At most this many events are drawn, evenly taken from all.
constexpr std::size_t max_drawn_events = 1500;

struct EventColumns
{
  const Column *cycle, *before, *after, *mode; ///< mode may be null
};

void add_events(const EventColumns &events, int mode, Chart &chart)
{
  const std::size_t n = events.cycle->size(),
                    stride = 1 + (n - 1) / max_drawn_events;
  Curve drop, before, after;
  drop.colour = before.colour = after.colour =
      palette_colour(static_cast<std::size_t>(mode - 1));
  drop.line_width = 0.6;
  drop.is_in_csv = false;
  before.line_width = after.line_width = 0.;
  before.marker_size = after.marker_size = n > 200 ? 1.6 : 2.5;
  before.marker = Marker::dot;
  after.marker = Marker::ring;
  const std::string cause = mode == 1 ? "cumulative" : "instantaneous";
  before.name = cause + ", before";
  after.name = cause + ", after";
  const double gap = std::numeric_limits<double>::quiet_NaN();
  for (std::size_t k = 0; k < n; k += stride)
  {
    if (events.mode && static_cast<int>((*events.mode)[k]) != mode)
      continue;
    const double x = (*events.cycle)[k];
    drop.x.insert(drop.x.end(), {x, x, gap});
    drop.y.insert(drop.y.end(), {(*events.before)[k], (*events.after)[k], gap});
    before.x.push_back(x);
    before.y.push_back((*events.before)[k]);
    after.x.push_back(x);
    after.y.push_back((*events.after)[k]);
  }
  if (before.x.empty())
    return;
  chart.curves.insert(chart.curves.end(), {drop, before, after});
  if (stride > 1 && chart.notes.empty())
    chart.notes.push_back("One of " + std::to_string(stride) +
                          " events is drawn.");
}

} // namespace

std::vector<Chart> event_charts(std::span<const RunData> runs)
{
  std::vector<Chart> charts;
  for (std::size_t k = 0; k < runs.size(); ++k)
  {
    Chart chart = chart_of_run(
        runs, k,
        {"breakage_forces", ReportSection::breakage,
         "Normal contact force just before (dots) and just after (rings) each "
         "breakage event, by the mode of the breakage criterion."});
    chart.y_label = "Contact force (N)";
    const Table &table = runs[k].events;
    const EventColumns events{
        find_or_note(table, "cycle_1", runs[k], chart),
        find_or_note(table, "force_before_N", runs[k], chart),
        find_or_note(table, "force_after_N", runs[k], chart),
        table.find("mode_1")};
    if (table.n_rows() == 0)
      chart.notes = {runs[k].name + ": no breakage events."};
    if (events.cycle && events.before && events.after)
      for (int mode = 1; mode <= (events.mode ? 2 : 1); ++mode)
        add_events(events, mode, chart);
    charts.push_back(chart);
  }
  return charts;
}

} // namespace spall
