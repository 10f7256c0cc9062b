#include "report/figure_parts.h"

#include <algorithm>
#include <cmath>

namespace spall
{
Column scaled(const Column &values, double factor)
{
  Column out(values);
  for (double &value : out)
    value *= factor;
  return out;
}

Column picked(const Column &values, const std::vector<std::size_t> &rows)
{
  Column out;
  for (const std::size_t row : rows)
    out.push_back(values[row]);
  return out;
}

Column since_start(const Column &values)
{
  Column out(values);
  for (double &value : out)
    value -= values.front();
  return out;
}

double largest(const Column &values)
{
  double out = 0.;
  for (const double value : values)
    if (std::isfinite(value))
      out = std::max(out, std::abs(value));
  return out;
}

const Column *find_or_note(const Table &table, const std::string &column,
                           const RunData &run, Chart &chart)
{
  const Column *found = table.find(column);
  if (!found)
    chart.notes.push_back(run.name + ": no column " + column + ".");
  else if (found->empty())
    chart.notes.push_back(run.name + ": no rows.");
  return found && !found->empty() ? found : nullptr;
}

Curve run_curve(std::span<const RunData> runs, std::size_t k)
{
  Curve curve;
  curve.name = runs.size() > 1 ? runs[k].name : "";
  curve.colour = palette_colour(k);
  curve.dash = palette_dash(k);
  return curve;
}

Chart chart_of_run(std::span<const RunData> runs, std::size_t k, Chart chart)
{
  chart.x_label = cycle_label;
  if (runs.size() > 1)
  {
    chart.id += "_" + std::to_string(k + 1);
    chart.caption += " Run: " + runs[k].name + ".";
  }
  return chart;
}
} // namespace spall
