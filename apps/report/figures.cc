#include "report/figures.h"

#include "report/figure_parts.h"
#include "report/gradation_chart.h"
#include "report/lab_figures.h"
#include "report/subgrade_figures.h"

#include <algorithm>
#include <cmath>

namespace spall
{
namespace
{
/// What of a history is drawn over the cycles.
enum class Sampling
{
  every_row,
  cycle_ends,
  both ///< a faint line and the ends of the cycles
};

struct Quantity
{
  std::string id, column, y_label, caption;
  double factor = 1.; ///< unit of the column in units of the label
  Sampling sampling = Sampling::cycle_ends;
};

const std::vector<Quantity> quantities{
    {"permanent_axial_strain", "axial_strain_1", "Permanent axial strain (%)",
     "Permanent axial strain at the end of each cycle. Compression is "
     "positive; zero is the start of loading.",
     100.},
    {"permanent_volumetric_strain", "volumetric_strain_1",
     "Permanent volumetric strain (%)",
     "Permanent volumetric strain at the end of each cycle. Compression is "
     "positive, dilation negative.",
     100.},
    {"abrasion", "laa_percent", "Abrasion LAA (%)",
     "Abrasion: mass lost by breakage over the initial mass.", 1.,
     Sampling::every_row},
    {"roundness", "roundness_1", "Roundness Rg (–)",
     "Roundness Rg (1: no corners), mean over the particles, once per cycle."},
    {"coordination_number", "coordination_number_1", "Coordination number (–)",
     "Mechanical coordination number: at the ends of the cycles (markers) and "
     "within them (faint line).",
     1., Sampling::both},
    {"contact_force", "mean_contact_force_N", "Mean contact force (N)",
     "Mean contact force between particles: at the ends of the cycles "
     "(markers) "
     "and "
     "within them (faint line).",
     1., Sampling::both}};

Chart over_cycles(const Quantity &quantity)
{
  return {quantity.id, quantity.caption, cycle_label, quantity.y_label};
}

std::vector<std::size_t> ends_with_last(const Table &loading)
{
  std::vector<std::size_t> rows = cycle_ends(loading);
  if (rows.size() == 1 && loading.n_rows() > 1)
    rows.push_back(loading.n_rows() - 1);
  return rows;
}

void add_run(const Quantity &quantity, std::span<const RunData> runs,
             std::size_t k, Chart &chart)
{
  const Table &loading = runs[k].loading;
  const Column *cycle = find_or_note(loading, "cycle_1", runs[k], chart);
  const Column *value = find_or_note(loading, quantity.column, runs[k], chart);
  if (!cycle || !value)
    return;
  const Column y = scaled(*value, quantity.factor);
  Curve curve = run_curve(runs, k);
  const bool has_ends = quantity.sampling != Sampling::every_row;
  // Several oscillating lines would hide each other.
  if (!has_ends || (quantity.sampling == Sampling::both && runs.size() == 1))
  {
    curve.x = *cycle;
    curve.y = y;
    if (has_ends)
    {
      Curve faint = curve;
      faint.name.clear();
      faint.colour = "#b9cfdd";
      faint.line_width = 1.;
      chart.curves.push_back(faint);
    }
  }
  if (has_ends)
  {
    const std::vector<std::size_t> rows = ends_with_last(loading);
    curve.x = picked(*cycle, rows);
    curve.y = picked(y, rows);
    curve.marker = rows.size() <= 60 ? Marker::dot : Marker::none;
  }
  chart.curves.push_back(curve);
}

Chart quantity_chart(const Quantity &quantity, std::span<const RunData> runs)
{
  Chart chart = over_cycles(quantity);
  for (std::size_t k = 0; k < runs.size(); ++k)
    add_run(quantity, runs, k, chart);
  if (runs.size() > 1 && quantity.sampling == Sampling::both)
    chart.caption = chart.caption.substr(0, chart.caption.find(':')) +
                    " at the end of each cycle.";
  return chart;
}

Chart event_count_chart(std::span<const RunData> runs)
{
  const Quantity count{"breakage_count",
                       "n_events_1",
                       "Breakage events (–)",
                       "Number of breakage events so far.",
                       1.,
                       Sampling::every_row};
  return quantity_chart(count, runs);
}

std::vector<Chart> charts_of_kind(std::span<const RunData> runs)
{
  if (are_subgrade_runs(runs))
    return make_subgrade_charts(runs);
  if (are_lab_runs(runs))
    return make_lab_charts(runs);
  std::vector<Chart> charts{loop_chart(runs)};
  for (const Quantity &quantity : quantities)
    charts.push_back(quantity_chart(quantity, runs));
  for (const Chart &chart : cycle_charts(runs))
    charts.push_back(chart);
  for (const Chart &chart : profile_charts(runs))
    charts.push_back(chart);
  charts.push_back(event_count_chart(runs));
  for (const Chart &chart : event_charts(runs))
    charts.push_back(chart);
  for (const Chart &chart : energy_charts(runs))
    charts.push_back(chart);
  charts.push_back(residual_chart(runs));
  return charts;
}
} // namespace

std::vector<Chart> make_charts(std::span<const RunData> runs)
{
  std::vector<Chart> charts = charts_of_kind(runs);
  if (have_gradation(runs))
    charts.push_back(gradation_chart(runs));
  return charts;
}
} // namespace spall
