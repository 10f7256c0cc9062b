#include "study/page_tables.h"

#include "report/text.h"
#include "study/differences.h"
#include "study/tables.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace spall
{
namespace
{
/// For a program that reads the file; empty if not finite.
std::string csv_number(double value)
{
  if (!std::isfinite(value))
    return "";
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", value);
  return text;
}

/// "Section/key = value" of the series, empty where there is one only.
std::string series_name(const StudyData &data, const Cut &cut)
{
  return cut.where_key
             ? data.study.keys[*cut.where_key].name() + " = " + cut.where_value
             : "";
}

std::string mean_and_deviation(const Level &level)
{
  return format(level.mean(), 4) + " ± " + format(level.deviation(), 2);
}

/// A difference that exceeds its interval, a dash for one that does not; the
/// mean itself where a single seed gives no interval.
std::string short_cell(const Difference &d)
{
  if (d.is_reference)
    return mean_and_deviation(d.level);
  if (d.over_seeds.n < 2)
    return format(d.level.mean(), 4);
  if (!d.over_seeds.is_resolved())
    return "–";
  return d.share() ? with_sign(*d.share()) : format(d.over_seeds.mean, 3);
}

/// One row for each outcome and series, one column for each value.
TextTable value_table(const StudyData &data, std::size_t key)
{
  const std::string name = data.study.keys[key].name();
  const std::string reference = reference_words(data, key);
  TextTable table{name + " against " + reference,
                  "Mean and standard deviation of " + reference +
                      ". Other values with their difference from it, of cases "
                      "with the same seed, where that exceeds its 95 % "
                      "interval over the seeds. A dash: within the interval.",
                  {"outcome"},
                  {}};
  const std::vector<Cut> series = series_of(data, key);
  if (series.front().where_key)
    table.head.push_back(data.study.keys[*series.front().where_key].name());
  const std::size_t n_names = table.head.size();
  for (const Level &level : levels_of(data, Cut(key), 0))
    table.head.push_back(level.value);
  bool has_seeds = false;
  for (const Difference &d : differences_of(data, key))
  {
    if (d.is_reference)
    {
      table.rows.emplace_back(table.head.size());
      table.rows.back()[0] = data.study.outcomes[d.outcome];
      if (d.cut.where_key)
        table.rows.back()[1] = d.cut.where_value;
    }
    has_seeds |= d.over_seeds.n > 1;
    // A series may lack some values.
    const auto column =
        std::find(table.head.begin() + static_cast<std::ptrdiff_t>(n_names),
                  table.head.end(), d.level.value);
    table.rows.back()[static_cast<std::size_t>(column - table.head.begin())] =
        short_cell(d);
  }
  if (!has_seeds)
    table.note = "Means of a single seed.";
  return table;
}

/// Outcome with the largest mean error over the spread.
std::string worst_outcome(const StudyData &data, const LevelCost &level,
                          const std::vector<double> &spread)
{
  std::string name;
  double largest = -1.;
  for (std::size_t o = 0; o < spread.size(); ++o)
    if (const double error = std::abs(level.errors[o].mean) / spread[o];
        !is_cost(data.study, data.study.outcomes[o]) && error > largest)
    {
      largest = error;
      name = data.study.outcomes[o];
    }
  return name;
}

std::string marks_of(const LevelCost &level)
{
  if (level.is_control)
    return "control";
  std::string marks = level.is_on_front ? "on the front" : "";
  if (level.is_cheapest_fine)
    marks += (marks.empty() ? "" : ", ") + std::string("cheapest that is fine");
  return marks;
}

TextTable short_cost_table(const StudyData &data)
{
  const Study &study = data.study;
  const std::vector<double> spread = reference_spread(data);
  TextTable table{
      "Error against cost",
      "Cost over that of the base case, and the largest mean error of any "
      "outcome over the standard deviation of the base case (" +
          std::to_string(reference_size(data)) +
          " specimens). Errors are of cases with the same seed. Fine: below "
          "half the spread in every outcome. Front: nothing else is cheaper "
          "and nearer. Controls differ by round-off alone.",
      {"key", "value", study.costs.front(), "worst error / spread", "in", ""},
      {}};
  for (const LevelCost &level : level_costs(data))
    table.rows.push_back({study.keys[level.key].name(), level.value,
                          format(level.cost(), 3), format(level.worst, 2),
                          worst_outcome(data, level, spread), marks_of(level)});
  return table;
}

TextTable error_file(const StudyData &data)
{
  const Study &study = data.study;
  TextTable table{"errors", "", {"key", "value"}, {}};
  table.head.insert(table.head.end(), study.costs.begin(), study.costs.end());
  table.head.insert(table.head.end(), {"worst_error_over_spread", "mark"});
  const std::vector<double> spread = reference_spread(data);
  Cells first = {"reference",
                 "spread of " + std::to_string(reference_size(data))};
  first.resize(table.head.size());
  for (std::size_t o = 0; o < spread.size(); ++o)
    if (const std::string &name = study.outcomes[o]; !is_cost(study, name))
    {
      table.head.insert(table.head.end(), {name, name + "_interval",
                                           name + "_percent_of_spread"});
      first.insert(first.end(), {csv_number(spread[o]), "", ""});
    }
  table.rows.push_back(first);
  for (const LevelCost &level : level_costs(data))
  {
    Cells cells = {study.keys[level.key].name(), level.value};
    for (const double cost : level.costs)
      cells.push_back(csv_number(cost));
    cells.insert(cells.end(), {csv_number(level.worst), marks_of(level)});
    for (std::size_t o = 0; o < spread.size(); ++o)
      if (!is_cost(study, study.outcomes[o]))
        cells.insert(cells.end(),
                     {csv_number(level.errors[o].mean),
                      csv_number(level.errors[o].half_width),
                      csv_number(100. * level.errors[o].mean / spread[o])});
    table.rows.push_back(cells);
  }
  return table;
}

TextTable difference_file(const StudyData &data)
{
  TextTable table{"differences",
                  "",
                  {"key", "value", "series", "outcome", "mean", "deviation",
                   "difference", "interval", "percent", "exceeds_spread"},
                  {}};
  for (std::size_t k = 0; k < data.study.keys.size(); ++k)
    for (const Difference &d : differences_of(data, k))
    {
      Cells cells = {
          data.study.keys[k].name(),  d.level.value,
          series_name(data, d.cut),   data.study.outcomes[d.outcome],
          csv_number(d.level.mean()), csv_number(d.level.deviation())};
      if (!d.is_reference)
        cells.insert(cells.end(),
                     {csv_number(d.over_seeds.mean),
                      csv_number(d.over_seeds.half_width),
                      d.share() ? csv_number(100. * *d.share()) : "",
                      d.over_seeds.n < 2           ? ""
                      : d.over_seeds.is_resolved() ? "yes"
                                                   : "no"});
      table.rows.push_back(cells);
    }
  return table;
}

/// Name, what is reported elsewhere, and whether it holds.
TextTable short_expectations(const StudyData &data)
{
  TextTable table = expectation_table(data);
  const auto without_results = [](const Cells &cells)
  {
    Cells kept = {cells[0], cells[2]};
    for (std::size_t c = 3; c < cells.size(); c += 2)
      kept.push_back(cells[c]);
    return kept;
  };
  table.head = without_results(table.head);
  for (Cells &row : table.rows)
    row = without_results(row);
  return table;
}
} // namespace

std::vector<PageFile> page_files(const StudyData &data, const std::string &stem)
{
  TextTable expectations = expectation_table(data);
  expectations.title = "expectations";
  std::vector<TextTable> tables = {expectations};
  if (data.study.has_reference())
    tables.push_back(error_file(data));
  tables.push_back(difference_file(data));
  std::vector<PageFile> files;
  for (const TextTable &table : tables)
    if (!table.rows.empty())
      files.push_back({table.title, stem + "_" + table.title + ".csv",
                       comma_separated(table)});
  return files;
}

std::string study_markdown(const StudyData &data, const std::string &stem)
{
  std::vector<TextTable> tables = {short_expectations(data)};
  if (data.study.has_reference())
  {
    tables.push_back(short_cost_table(data));
    tables.push_back(default_table(data));
  }
  else
    for (std::size_t k = 0; k < data.study.keys.size(); ++k)
      tables.push_back(value_table(data, k));
  tables.push_back(failure_table(data));
  std::string text;
  for (const TextTable &table : tables)
    if (!table.rows.empty())
      text += markdown(table);
  std::string links = "All values as files:";
  const std::vector<PageFile> files = page_files(data, stem);
  for (const PageFile &file : files)
    links += (&file == &files.front() ? " [" : ", [") + file.words + "](" +
             file.name + ")";
  return text + in_lines(links + ".") + "\n";
}
} // namespace spall
