#include "report/lab_figures.h"

#include "report/compaction_figures.h"
#include "report/figure_parts.h"
#include "report/roundness_chart.h"

#include <array>
#include <cmath>

namespace spall
{
namespace
{
/// What a test of this kind goes along.
struct Path
{
  const char *column, *label;
  double factor; ///< unit of the column in units of the label
};

constexpr Path press{"displacement_m", "Displacement (mm)", 1e3};
constexpr Path drum{"turn_1", "Turns (–)", 1.};
constexpr Path vibration{"vibration_s", "Time of vibration (s)", 1.};

struct Quantity
{
  const char *id, *column, *label, *caption;
  double factor = 1.;
};

constexpr std::array press_quantities = {
    Quantity{"breakage_count", "n_events_1", "Breakage events (–)",
             "Number of breakage events so far, Nb."},
    Quantity{"abrasion", "laa_percent", "Mass lost (%)",
             "Mass lost by breakage over the initial mass."}};
constexpr std::array drum_quantities = {
    Quantity{
        "abrasion", "laa_percent", "Abrasion LAA (%)",
        "Abrasion LAA: mass that the particles have lost over their initial "
        "mass; the steel balls do not count."},
    Quantity{"breakage_count", "n_events_1", "Breakage events (–)",
             "Number of breakage events so far."},
    Quantity{"roundness", "roundness_1", "Roundness Rg (–)",
             "Mean roundness of the particles, by volume."},
    Quantity{"torque", "torque_Nm", "Torque (N m)",
             "Moment of the charge on the drum about its axis."},
    Quantity{"contacts", "n_contacts_1", "Contacts (–)",
             "Contacts between particles and balls at the moment."}};

bool is_press(const RunData &run)
{
  return run.loading.find(press.column) != nullptr;
}

Chart quantity_chart(std::span<const RunData> runs, const Path &path,
                     const Quantity &quantity)
{
  Chart chart{quantity.id, quantity.caption, path.label, quantity.label};
  for (std::size_t k = 0; k < runs.size(); ++k)
  {
    const Table &table = runs[k].loading;
    const Column *x = find_or_note(table, path.column, runs[k], chart);
    const Column *y = find_or_note(table, quantity.column, runs[k], chart);
    if (!x || !y)
      continue;
    Curve curve = run_curve(runs, k);
    curve.x = scaled(*x, path.factor);
    curve.y = scaled(*y, quantity.factor);
    chart.curves.push_back(curve);
  }
  return chart;
}

/// Where the force drops: mode I as dots, mode II as rings.
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
  Chart chart = quantity_chart(
      runs, press,
      {"force_displacement", "force_N", "Force (N)",
       "Force on the upper platen over its displacement. Each drop is a "
       "breakage event; markers: force of the contact just before."});
  if (runs.size() == 1)
    add_events(runs[0], chart);
  return chart;
}

/// Loss per turn between the rows of the history, in ten parts of the run.
Chart rate_chart(std::span<const RunData> runs)
{
  Chart chart{"abrasion_rate",
              "Abrasion per turn, mean over tenths of the run.", drum.label,
              "LAA per turn (%)"};
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

constexpr std::array energy_terms = {
    std::pair{"external_work_J", "external work"},
    std::pair{"friction_dissipation_J", "friction"},
    std::pair{"damping_dissipation_J", "damping"},
    std::pair{"rolling_dissipation_J", "rolling"},
    std::pair{"elastic_energy_J", "elastic"},
    std::pair{"kinetic_energy_J", "kinetic"},
    std::pair{"breakage_energy_J", "breakage"},
    std::pair{"non_conservative_work_J", "non-conservative work"},
    std::pair{"energy_residual_J", "residual"}};

std::vector<Chart> energy_charts(std::span<const RunData> runs,
                                 const Path &path)
{
  std::vector<Chart> charts;
  for (std::size_t k = 0; k < runs.size(); ++k)
  {
    Chart chart = chart_of_run(
        runs, k,
        {"energies", "Where the external work has gone, from the start."});
    chart.x_label = path.label;
    chart.y_label = "Energy (J)";
    const Column *x =
        find_or_note(runs[k].loading, path.column, runs[k], chart);
    for (std::size_t t = 0; x && t < energy_terms.size(); ++t)
      if (const Column *y = runs[k].loading.find(energy_terms[t].first))
      {
        Curve curve;
        curve.name = energy_terms[t].second;
        curve.colour = palette_colour(t);
        curve.dash = palette_dash(t);
        curve.x = scaled(*x, path.factor);
        curve.y = *y;
        chart.curves.push_back(curve);
      }
    charts.push_back(chart);
  }
  return charts;
}
} // namespace

bool are_lab_runs(std::span<const RunData> runs)
{
  return !runs.empty() && (is_press(runs[0]) || is_compaction(runs[0]) ||
                           runs[0].loading.find(drum.column) != nullptr);
}

std::vector<Chart> make_lab_charts(std::span<const RunData> runs)
{
  std::vector<Chart> charts;
  const Path &path = is_press(runs[0])        ? press
                     : is_compaction(runs[0]) ? vibration
                                              : drum;
  if (is_compaction(runs[0]))
    charts = make_compaction_charts(runs);
  else if (is_press(runs[0]))
  {
    charts.push_back(force_chart(runs));
    for (const Quantity &quantity : press_quantities)
      charts.push_back(quantity_chart(runs, path, quantity));
  }
  else
  {
    for (const Quantity &quantity : drum_quantities)
      charts.push_back(quantity_chart(runs, path, quantity));
    charts.push_back(rate_chart(runs));
    charts.push_back(roundness_chart(runs));
  }
  for (const Chart &chart : energy_charts(runs, path))
    charts.push_back(chart);
  return charts;
}
} // namespace spall
