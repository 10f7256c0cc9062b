#include "report/figure_parts.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace spall
{
namespace
{
struct EnergyTerm
{
  const char *column, *name;
};

constexpr EnergyTerm energy_terms[]{
    {"external_work_J", "external work"},
    {"friction_dissipation_J", "friction"},
    {"damping_dissipation_J", "damping"},
    {"rolling_dissipation_J", "rolling"},
    {"elastic_energy_J", "elastic"},
    {"breakage_energy_J", "breakage"},
    {"kinetic_energy_J", "kinetic"},
    {"membrane_strain_energy_J", "membrane"},
    {"non_conservative_work_J", "non-conservative work"}};

struct EnergyUnit
{
  double factor;
  const char *name;
};

EnergyUnit energy_unit(double size)
{
  if (size >= 1e4)
    return {1e-3, "kJ"};
  if (size >= 0.1)
    return {1., "J"};
  return size >= 1e-4 ? EnergyUnit{1e3, "mJ"} : EnergyUnit{1e6, "µJ"};
}

/// Terms below this share of the largest one get axes of their own.
constexpr double small_share = 0.12;

double largest_energy(const RunData &run)
{
  double size = 0.;
  for (const EnergyTerm &term : energy_terms)
    if (const Column *energy = run.loading.find(term.column))
      size = std::max(size, largest(since_start(*energy)));
  return size;
}

/// Adds the terms whose largest value is in (above, up_to].
void add_energies(const RunData &run, double above, double up_to, Chart &chart)
{
  const Column *cycle = find_or_note(run.loading, "cycle_1", run, chart);
  if (!cycle)
    return;
  const EnergyUnit unit = energy_unit(up_to);
  chart.y_label = std::string("Energy (") + unit.name + ")";
  for (std::size_t k = 0; k < std::size(energy_terms); ++k)
  {
    const Column *energy = run.loading.find(energy_terms[k].column);
    if (!energy)
      continue;
    const Column change = since_start(*energy);
    if (largest(change) <= above || largest(change) > up_to)
      continue;
    Curve curve{energy_terms[k].name, *cycle, scaled(change, unit.factor)};
    curve.colour = k == 0 ? "#222222" : palette_colour(k - 1);
    curve.dash = k > 6 ? palette_dash(1) : "";
    curve.line_width = k == 0 ? 2. : 1.5;
    chart.curves.push_back(curve);
  }
}
} // namespace

std::vector<Chart> energy_charts(std::span<const RunData> runs)
{
  std::vector<Chart> charts;
  for (std::size_t k = 0; k < runs.size(); ++k)
  {
    const double size = largest_energy(runs[k]);
    Chart large = chart_of_run(
        runs, k,
        {"energies", ReportSection::energy,
         "External work, dissipation and changes of the stored energies since "
         "the start of loading: the large terms."});
    Chart small = chart_of_run(
        runs, k,
        {"small_energies", ReportSection::energy,
         "External work, dissipation and changes of the stored energies since "
         "the start of loading: terms below 12 % of the largest one."});
    add_energies(runs[k], small_share * size, size, large);
    add_energies(runs[k], 0., small_share * size, small);
    if (large.curves.empty())
      large.notes.push_back(runs[k].name + ": no energies.");
    charts.insert(charts.end(), {large, small});
  }
  return charts;
}

Chart residual_chart(std::span<const RunData> runs)
{
  Chart chart{"energy_residual", ReportSection::energy,
              "Residual of the energy balance divided by the largest external "
              "work so far, both since the start of loading.",
              cycle_label, "Energy residual (%)"};
  for (std::size_t k = 0; k < runs.size(); ++k)
  {
    const Table &loading = runs[k].loading;
    const Column *cycle = find_or_note(loading, "cycle_1", runs[k], chart);
    const Column *external =
        find_or_note(loading, "external_work_J", runs[k], chart);
    const Column *booked =
        find_or_note(loading, "energy_residual_J", runs[k], chart);
    if (!cycle || !external || !booked)
      continue;
    const Column work = since_start(*external), residual = since_start(*booked);
    Curve curve = run_curve(runs, k);
    curve.x = *cycle;
    // The first rows divide nothing by nothing.
    const double smallest = 0.02 * largest(work);
    double size = 0.;
    for (std::size_t row = 0; row < work.size(); ++row)
    {
      size = std::max(size, std::abs(work[row]));
      curve.y.push_back(size > smallest
                            ? 100. * residual[row] / size
                            : std::numeric_limits<double>::quiet_NaN());
    }
    chart.curves.push_back(curve);
  }
  return chart;
}

} // namespace spall
