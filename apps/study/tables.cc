#include "study/tables.h"

#include "report/text.h"
#include "study/judge.h"

#include <cmath>

namespace spall
{
namespace
{
using Cells = std::vector<std::string>;

std::string row(const Cells &cells, const char *tag = "td")
{
  std::string out = "<tr>";
  for (const std::string &cell : cells)
    out += std::string("<") + tag + ">" + escape(cell) + "</" + tag + ">";
  return out + "</tr>\n";
}

std::string table(const Cells &head, const std::string &rows)
{
  return "<div class=\"wide\"><table><thead>" + row(head, "th") +
         "</thead><tbody>\n" + rows + "</tbody></table></div>\n";
}

std::string section(const std::string &title, const std::string &body)
{
  return "<section>\n<h2>" + escape(title) + "</h2>\n" + body + "</section>\n";
}

std::string in_words(Ruling ruling)
{
  switch (ruling)
  {
  case Ruling::holds:
    return "yes";
  case Ruling::does_not:
    return "no";
  case Ruling::not_resolved:
    break;
  }
  return "not resolved";
}

std::string in_words(const Expectation &e)
{
  return e.outcome + " " + e.relation + " with " + e.key +
         (e.than.empty() ? "" : " than " + e.than) +
         (e.where_key.empty()
              ? ""
              : " where " + e.where_key + " = " + e.where_value);
}

std::string with_sign(double share)
{
  return (share > 0. ? "+" : "") + format(100. * share, 2) + " %";
}
} // namespace

std::string expectation_table(const StudyData &data)
{
  if (data.study.expectations.empty())
    return "";
  std::string rows;
  for (const Expectation &e : data.study.expectations)
  {
    const Verdict verdict = judge(data, e);
    rows += row({e.name, in_words(e), e.reported, in_words(verdict.ruling),
                 verdict.numbers});
  }
  const std::string rule =
      data.study.judged_by == JudgedBy::seeds
          ? "Differences are of cases with the same seed, with their 95 % "
            "interval over the seeds; what is within it is not resolved."
          : "Differences of means count from 5 % of the mean of all on.";
  return section(
      "Expectations",
      "<p>" + rule + "</p>\n" +
          table({"name", "expected", "reported", "shown", "means"}, rows));
}

std::string difference_table(const StudyData &data, std::size_t key)
{
  const Cut cut(key);
  std::string rows;
  for (std::size_t o = 0; o < data.study.outcomes.size(); ++o)
  {
    const std::vector<Level> levels = levels_of(data, cut, o);
    for (std::size_t l = 0; l < levels.size(); ++l)
    {
      Cells cells = {l == 0 ? data.study.outcomes[o] : "", levels[l].value,
                     format(levels[l].mean(), 4) + " ± " +
                         format(levels[l].deviation(), 2)};
      if (l > 0)
      {
        const Estimate e = estimate_of(
            paired_differences(data, cut, o, levels[0].value, levels[l].value));
        cells.push_back(in_words(e, std::abs(levels[0].mean())));
        cells.push_back(e.n < 2           ? "one seed"
                        : e.is_resolved() ? "exceeds the spread"
                                          : "within the spread");
      }
      rows += row(cells);
    }
  }
  return "<details><summary>Against the first value</summary><p>Mean and "
         "standard deviation of all cases; differences are of cases with the "
         "same seed, with their 95 % interval over the seeds.</p>" +
         table({"outcome", data.study.keys[key].name(), "mean", "difference",
                "over seeds"},
               rows) +
         "</details>\n";
}

std::string price_table(const StudyData &data)
{
  const std::vector<PricedLevel> levels = price_levels(data);
  if (levels.empty())
    return "";
  const Study &study = data.study;
  const std::vector<double> spread = reference_spread(data);
  Cells head = {"key", "value", "cost", "worst error / spread"};
  for (const std::string &outcome : study.outcomes)
    if (outcome != study.cost)
      head.push_back(outcome);
  std::string rows;
  for (const PricedLevel &level : levels)
  {
    Cells cells = {
        study.keys[level.key].name(), level.value, format(level.cost, 3),
        format(level.worst, 2) + (level.is_on_front ? ", on the front" : "") +
            (level.is_cheapest_fine ? ", cheapest that is fine" : "")};
    for (std::size_t o = 0; o < study.outcomes.size(); ++o)
      if (study.outcomes[o] != study.cost)
        cells.push_back(
            in_words(level.errors[o], 0.) + " = " +
            with_sign(level.errors[o].mean / spread[o]) +
            (level.errors[o].is_resolved() ? "" : ", not resolved"));
    rows += row(cells);
  }
  return section(
      "Error against cost",
      "<p>Cost and errors against the base case, in pairs with the same seed; "
      "errors in their own unit with their 95 % interval, and in per cent of "
      "the standard deviation that the base case has over its seeds. Fine is "
      "what stays below half of it in every outcome.</p>\n" +
          table(head, rows));
}

std::string failure_table(const StudyData &data)
{
  std::string rows;
  for (std::size_t p = 0; p < data.points.size(); ++p)
    if (!data.results[p].is_done)
    {
      std::string values;
      for (std::size_t k = 0; k < data.study.keys.size(); ++k)
        values += (k > 0 ? ", " : "") + data.study.keys[k].name() + " = " +
                  data.points[p].values[k];
      rows += row({data.points[p].folder, values, data.results[p].fault});
    }
  return rows.empty()
             ? ""
             : section("Cases that failed", "<table>" + rows + "</table>\n");
}

std::string case_table(const StudyData &data)
{
  Cells head = {"run"};
  for (const SweptKey &key : data.study.keys)
    head.push_back(key.name());
  head.emplace_back("seed");
  head.insert(head.end(), data.study.outcomes.begin(),
              data.study.outcomes.end());
  std::string rows;
  for (std::size_t p = 0; p < data.points.size(); ++p)
  {
    Cells cells = {data.points[p].folder};
    cells.insert(cells.end(), data.points[p].values.begin(),
                 data.points[p].values.end());
    cells.push_back(data.points[p].seed);
    for (const double value : data.results[p].outcomes)
      cells.push_back(format(value, 5));
    rows += row(cells);
  }
  return section("Cases", "<details><summary>" +
                              std::to_string(data.points.size()) +
                              " cases (study.csv)</summary>" +
                              table(head, rows) + "</details>\n");
}
} // namespace spall
