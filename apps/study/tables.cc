#include "study/tables.h"

#include "report/text.h"
#include "study/after_cycles.h"
#include "study/differences.h"
#include "study/judge.h"

#include <cmath>

namespace spall
{
namespace
{
std::string in_words(Ruling ruling)
{
  switch (ruling)
  {
  case Ruling::holds:
    return "yes";
  case Ruling::does_not:
    return "no";
  case Ruling::unchanged:
    return "unchanged";
  case Ruling::not_resolved:
    break;
  }
  return "not resolved";
}

/// Cells that identify a row: the outcome, and the other key's value.
Cells row_name(const StudyData &data, const Difference &d)
{
  Cells cells = {data.study.outcomes[d.outcome]};
  if (d.cut.where_key)
    cells.push_back(d.cut.where_value);
  return cells;
}

/// A head that begins with what row_name() gives.
Cells head_of(const StudyData &data, std::size_t key, const Cells &more)
{
  Cells head = {"outcome"};
  if (const Cut cut = series_of(data, key).front(); cut.where_key)
    head.push_back(data.study.keys[*cut.where_key].name());
  head.insert(head.end(), more.begin(), more.end());
  return head;
}
} // namespace

TextTable expectation_table(const StudyData &data)
{
  TextTable table{"Expectations",
                  data.study.judged_by == JudgedBy::seeds
                      ? "Differences are of cases with the same seed, with "
                        "their 95 % interval over the seeds; what is within it "
                        "is not resolved. Unchanged: by less than 5 %."
                      : "Differences of means count from 5 % of the mean of "
                        "all on.",
                  {"name", "expected", "reported"},
                  {}};
  for (const int cycle : data.study.after_cycles)
    for (const std::string what : {"holds", "result"})
      table.head.push_back(what + " after " + std::to_string(cycle));
  table.head.insert(table.head.end(), {"holds", "result"});
  for (const Expectation &e : data.study.expectations)
    table.rows.push_back({e.name, in_words(e), e.reported});
  const auto add_verdicts = [&table](const StudyData &state)
  {
    for (std::size_t e = 0; e < table.rows.size(); ++e)
    {
      const Verdict verdict = judge(state, state.study.expectations[e]);
      table.rows[e].insert(
          table.rows[e].end(),
          {in_words(verdict.ruling), verdict.levels + verdict.numbers});
    }
  };
  for (std::size_t k = 0; k < data.study.after_cycles.size(); ++k)
  {
    const std::vector<PointResult> results = results_after(data, k);
    add_verdicts({data.study, data.points, results});
  }
  add_verdicts(data);
  return table;
}

TextTable difference_table(const StudyData &data, std::size_t key)
{
  const std::string name = data.study.keys[key].name();
  TextTable table{
      name + " against " + reference_words(data, key),
      "Mean and standard deviation of the cases; differences are of cases with "
      "the same seed, with their 95 % interval over the seeds.",
      head_of(data, key, {name, "mean", "difference", "over seeds"}),
      {}};
  for (const Difference &d : differences_of(data, key))
  {
    Cells cells = row_name(data, d);
    cells.insert(cells.end(),
                 {d.level.value, format(d.level.mean(), 4) + " ± " +
                                     format(d.level.deviation(), 2)});
    if (d.is_reference)
      cells.insert(cells.end(), {"–", "–"});
    else
      cells.insert(
          cells.end(),
          {in_words(d.over_seeds, d.share() ? std::abs(d.reference) : 0.),
           d.over_seeds.n < 2           ? "one seed"
           : d.over_seeds.is_resolved() ? "exceeds the spread"
                                        : "within the spread"});
    table.rows.push_back(cells);
  }
  return table;
}

TextTable spread_table(const StudyData &data, std::size_t key)
{
  const std::string name = data.study.keys[key].name();
  TextTable table{
      name + ": what exceeds the spread",
      "Values that differ from " + reference_words(data, key) +
          " by more than the 95 % interval over the seeds, with their "
          "difference, and those that do not.",
      head_of(data, key, {"against", "exceeds the spread", "within it"}),
      {}};
  bool has_seeds = false;
  for (const Difference &d : differences_of(data, key))
  {
    if (d.is_reference)
    {
      table.rows.push_back(row_name(data, d));
      table.rows.back().insert(table.rows.back().end(),
                               {d.level.value, "", ""});
    }
    if (d.over_seeds.n < 2)
      continue;
    has_seeds = true;
    Cells &row = table.rows.back();
    std::string &list =
        d.over_seeds.is_resolved() ? row[row.size() - 2] : row.back();
    list += (list.empty() ? "" : ", ") + d.level.value;
    if (d.over_seeds.is_resolved())
      list += d.share() ? " (" + with_sign(*d.share()) + ")"
                        : " (" + format(d.over_seeds.mean, 3) + ")";
  }
  if (!has_seeds)
    table.rows.clear();
  for (Cells &row : table.rows)
    for (std::string &cell : row)
      if (cell.empty())
        cell = "none";
  return table;
}

namespace
{
/// What the reference differs by from seed to seed.
Cells spread_row(const StudyData &data, const std::vector<double> &spread)
{
  const Study &study = data.study;
  Cells cells = {"reference",
                 "spread of " + std::to_string(reference_size(data))};
  cells.resize(cells.size() + study.costs.size() + 2);
  for (std::size_t o = 0; o < spread.size(); ++o)
    if (!is_cost(study, study.outcomes[o]))
      cells.push_back(format(spread[o], 3));
  return cells;
}
} // namespace

TextTable cost_table(const StudyData &data)
{
  const Study &study = data.study;
  TextTable table{
      "Error against cost",
      "Cost and errors against the base case, in pairs with the same seed; "
      "errors in their own unit with their 95 % interval, and in per cent of "
      "the standard deviation of the base case over all its seeds. Fine is "
      "what stays below half of it in every outcome; controls show what chaos "
      "alone makes.",
      {"key", "value"},
      {}};
  table.head.insert(table.head.end(), study.costs.begin(), study.costs.end());
  table.head.insert(table.head.end(), {"worst error / spread", ""});
  for (const std::string &outcome : study.outcomes)
    if (!is_cost(study, outcome))
      table.head.push_back(outcome);
  const std::vector<double> spread = reference_spread(data);
  table.rows.push_back(spread_row(data, spread));
  for (const LevelCost &level : level_costs(data))
  {
    std::string marks = level.is_on_front ? "on the front" : "";
    if (level.is_cheapest_fine)
      marks +=
          (marks.empty() ? "" : ", ") + std::string("cheapest that is fine");
    if (level.is_control)
      marks = "control";
    Cells cells = {study.keys[level.key].name(), level.value};
    for (const double cost : level.costs)
      cells.push_back(format(cost, 3));
    cells.insert(cells.end(), {format(level.worst, 2), marks});
    for (std::size_t o = 0; o < study.outcomes.size(); ++o)
      if (!is_cost(study, study.outcomes[o]))
        cells.push_back(
            in_words(level.errors[o], 0.) + " = " +
            with_sign(level.errors[o].mean / spread[o]) +
            (level.errors[o].is_resolved() ? "" : ", not resolved"));
    table.rows.push_back(cells);
  }
  return table;
}

TextTable default_table(const StudyData &data)
{
  TextTable table{
      "Defaults",
      "The default of the program against the cheapest value whose errors all "
      "stay below half the spread of the seeds and whose cost is below that of "
      "the reference by its interval; reference where there is none. A default "
      "that is fine and costs no more than that one, by the interval, or is "
      "part of it, is right.",
      {"key", "default", data.study.costs.front(), "worst error / spread",
       "cheapest that is fine", "is the default"},
      {}};
  for (const DefaultCost &price : default_costs(data, level_costs(data)))
  {
    const bool is_there = price.is_measured();
    table.rows.push_back({price.parameter, price.default_value,
                          is_there ? format(price.cost, 3) : "not in this map",
                          is_there ? format(price.worst, 2) : "",
                          price.cheapest,
                          price.is_right ? "yes"
                          : is_there     ? "no"
                                         : "not measured"});
  }
  return table;
}

TextTable failure_table(const StudyData &data)
{
  TextTable table{"Cases that failed", "", {"run", "values", "fault"}, {}};
  for (std::size_t p = 0; p < data.points.size(); ++p)
    if (!data.results[p].is_done)
    {
      std::string values;
      for (std::size_t k = 0; k < data.study.keys.size(); ++k)
        values += (k > 0 ? ", " : "") + data.study.keys[k].name() + " = " +
                  data.points[p].values_in_case[k];
      table.rows.push_back(
          {data.points[p].folder, values, data.results[p].fault});
    }
  return table;
}

TextTable case_table(const StudyData &data)
{
  TextTable table{"Cases", "", {"run"}, {}};
  for (const SweptKey &key : data.study.keys)
    table.head.push_back(key.name());
  table.head.emplace_back("seed");
  table.head.insert(table.head.end(), data.study.outcomes.begin(),
                    data.study.outcomes.end());
  for (std::size_t p = 0; p < data.points.size(); ++p)
  {
    Cells cells = {data.points[p].folder};
    cells.insert(cells.end(), data.points[p].values_in_case.begin(),
                 data.points[p].values_in_case.end());
    cells.push_back(data.points[p].seed);
    for (const double value : data.results[p].outcomes)
      cells.push_back(format(value, 5));
    table.rows.push_back(cells);
  }
  return table;
}
} // namespace spall
