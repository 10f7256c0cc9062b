#include "report/figure_parts.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>

namespace spall
{
namespace
{
/// Cycles whose loops are drawn: all of a short test, else 1, 2, 5, 10, ...
std::vector<int> loop_cycles(int n_cycles)
{
  std::vector<int> cycles;
  if (n_cycles <= 12)
    for (int k = 1; k <= n_cycles; ++k)
      cycles.push_back(k);
  else
  {
    for (int decade = 1; decade < n_cycles; decade *= 10)
      for (const int k : {decade, 2 * decade, 5 * decade})
        if (k < n_cycles)
          cycles.push_back(k);
    cycles.push_back(n_cycles);
  }
  return cycles;
}

/// From light to dark blue.
std::string loop_colour(double share)
{
  const double light[]{128., 184., 220.}, dark[]{8., 48., 107.};
  char text[8];
  int rgb[3];
  for (int i = 0; i < 3; ++i)
    rgb[i] = static_cast<int>(light[i] + share * (dark[i] - light[i]));
  std::snprintf(text, sizeof text, "#%02x%02x%02x", rgb[0], rgb[1], rgb[2]);
  return text;
}

struct Loops
{
  Column cycle, strain, stress; ///< [-], [%], [kPa]
};

std::optional<Loops> read_loops(const RunData &run, Chart &chart)
{
  const Column *cycle = find_or_note(run.loading, "cycle_1", run, chart);
  const Column *strain =
      find_or_note(run.loading, "axial_strain_1", run, chart);
  const Column *axial =
      find_or_note(run.loading, "axial_stress_Pa", run, chart);
  const Column *lateral =
      find_or_note(run.loading, "lateral_stress_Pa", run, chart);
  if (!cycle || !strain || !axial || !lateral)
    return std::nullopt;
  Loops loops{*cycle, scaled(*strain, 100.), scaled(*axial, 1e-3)};
  for (std::size_t k = 0; k < loops.stress.size(); ++k)
    loops.stress[k] -= 1e-3 * (*lateral)[k];
  return loops;
}

/// One curve per cycle, light to dark.
void add_cycles(const Loops &loops, Chart &chart)
{
  const auto n =
      std::max(1, static_cast<int>(std::ceil(loops.cycle.back() - 0.01)));
  const std::vector<int> cycles = loop_cycles(n);
  for (std::size_t i = 0; i < cycles.size(); ++i)
  {
    Curve curve;
    curve.line_width = 1.3;
    curve.colour = loop_colour(
        cycles.size() < 2
            ? 1.
            : static_cast<double>(i) / static_cast<double>(cycles.size() - 1));
    const bool is_named = cycles.size() <= 5 || i == 0 ||
                          i + 1 == cycles.size() || i == cycles.size() / 2;
    curve.csv_name = "cycle " + std::to_string(cycles[i]);
    curve.name = is_named ? curve.csv_name : "";
    for (std::size_t k = 0; k < loops.cycle.size(); ++k)
      if (loops.cycle[k] >= cycles[i] - 1.01 &&
          loops.cycle[k] <= cycles[i] + 0.01)
      {
        curve.x.push_back(loops.strain[k]);
        curve.y.push_back(loops.stress[k]);
      }
    chart.curves.push_back(curve);
  }
}

} // namespace

Chart loop_chart(std::span<const RunData> runs)
{
  Chart chart{"stress_strain_loops", ReportSection::response,
              "Stress-strain loops: deviator stress (axial minus lateral "
              "stress) and axial strain, compression positive.",
              "Axial strain (%)", "Deviator stress (kPa)"};
  for (std::size_t k = 0; k < runs.size(); ++k)
  {
    const std::optional<Loops> loops = read_loops(runs[k], chart);
    if (!loops)
      continue;
    if (runs.size() == 1)
    {
      add_cycles(*loops, chart);
      continue;
    }
    Curve curve = run_curve(runs, k);
    curve.dash.clear(); // loops of dashes cannot be read
    curve.line_width = 1.1;
    curve.x = loops->strain;
    curve.y = loops->stress;
    chart.curves.push_back(curve);
  }
  return chart;
}

} // namespace spall
