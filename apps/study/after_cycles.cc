#include "study/after_cycles.h"

#include "errors.h"
#include "report/run_data.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <limits>

namespace spall
{
namespace
{
/// How an outcome follows from the rows of cycles.csv.
enum class FromRows
{
  value,      ///< of the row
  sum,        ///< of all rows so far
  difference, ///< from the start
  share       ///< of the start that it has changed by
};

struct OutcomeColumn
{
  std::string outcome, column;
  FromRows rule = FromRows::value;
  std::string start = {}; ///< key of summary.json
};

/// Outcomes whose column has another name.
const std::array<OutcomeColumn, 8> renamed = {
    {{"coordination_end_1", "coordination_number_1"},
     {"coordination_change_1", "coordination_number_1", FromRows::difference,
      "coordination_start_1"},
     {"coordination_peak_1", "coordination_number_peak_1"},
     {"roundness_end_1", "roundness_1"},
     {"roundness_change_1", "roundness_1", FromRows::difference,
      "roundness_start_1"},
     {"mean_contact_force_end_N", "mean_contact_force_N"},
     {"mean_contact_force_change_1", "mean_contact_force_N", FromRows::share,
      "mean_contact_force_start_N"},
     {"n_events", "n_events_1", FromRows::sum}}};

OutcomeColumn column_of(const std::string &outcome)
{
  const auto found =
      std::ranges::find(renamed, outcome, &OutcomeColumn::outcome);
  return found != renamed.end() ? *found : OutcomeColumn{outcome, outcome};
}

/// The rows of a run; none if it wrote no file of them, or not a whole one.
Table cycles_of(const std::filesystem::path &run)
{
  try
  {
    return read_table(run / "cycles.csv");
  }
  catch (const InputError &)
  {
    return {};
  }
}

/// Rows that a cycle lies between, and its share of the way to the second.
struct Between
{
  std::size_t before, after;
  double share;
};

/// Cycles rise from row to row.
Between find_cycle(const std::vector<double> &cycles, double cycle)
{
  const auto found = std::ranges::lower_bound(cycles, cycle);
  const auto after = static_cast<std::size_t>(found - cycles.begin());
  if (after == 0)
    return {0, 0, 1.};
  return {after - 1, after,
          (cycle - cycles[after - 1]) / (cycles[after] - cycles[after - 1])};
}

/// A column at a cycle, before the start is taken off.
double value_at(const Between &rows, std::vector<double> column, bool is_sum)
{
  if (is_sum)
    for (std::size_t r = 1; r < column.size(); ++r)
      column[r] += column[r - 1];
  return rows.share == 1.
             ? column[rows.after]
             : std::lerp(column[rows.before], column[rows.after], rows.share);
}
} // namespace

std::vector<double> outcomes_after(int cycle,
                                   const std::vector<std::string> &outcomes,
                                   const std::filesystem::path &run)
{
  std::vector<double> values(outcomes.size(),
                             std::numeric_limits<double>::quiet_NaN());
  const Table table = cycles_of(run);
  const std::vector<double> *cycles = table.find("cycle_1");
  if (!cycles || cycles->empty() || cycle < cycles->front() ||
      cycle > cycles->back())
    return values;
  std::ifstream in(run / "summary.json");
  const auto summary = nlohmann::ordered_json::parse(in, nullptr, false);
  const Between rows = find_cycle(*cycles, cycle);
  for (std::size_t o = 0; o < outcomes.size(); ++o)
  {
    const OutcomeColumn from = column_of(outcomes[o]);
    const std::vector<double> *column = table.find(from.column);
    if (!column)
      continue;
    values[o] = value_at(rows, *column, from.rule == FromRows::sum);
    if (from.start.empty())
      continue;
    const double start = summary.is_object()
                             ? number(summary, from.start)
                             : std::numeric_limits<double>::quiet_NaN();
    values[o] -= start;
    if (from.rule == FromRows::share)
      values[o] /= start;
  }
  return values;
}

std::vector<PointResult> results_after(const StudyData &data, std::size_t k)
{
  std::vector<PointResult> results(data.results.begin(), data.results.end());
  for (PointResult &result : results)
    result.outcomes = result.outcomes_after[k];
  return results;
}
} // namespace spall
