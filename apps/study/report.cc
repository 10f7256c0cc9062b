#include "report/chart.h"
#include "report/figure_parts.h"
#include "report/page.h"
#include "report/text.h"
#include "run/folder.h"
#include "study/levels.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace spall
{
namespace
{
namespace fs = std::filesystem;

/// How a key is drawn along x: sweeps over more than this factor by powers.
constexpr double many_times = 20.;

struct Abscissa
{
  std::string label;
  bool is_logarithmic = false;

  double operator()(double x) const
  {
    return is_logarithmic ? std::log10(x) : x;
  }
};

Abscissa abscissa_of(const SweptKey &key, const std::vector<Level> &levels)
{
  const bool is_wide = !key.is_variant() && !levels.empty() &&
                       levels.front().x > 0. &&
                       levels.back().x > many_times * levels.front().x;
  return {(is_wide ? "log10 of " : "") + key.name(), is_wide};
}

/// Means with error bars of one standard deviation, and the single cases.
Chart level_chart(const StudyData &data, std::size_t k, std::size_t outcome)
{
  const SweptKey &key = data.study.keys[k];
  const std::string &name = data.study.outcomes[outcome];
  const std::vector<Level> levels = levels_of(data, k, outcome);
  const Abscissa along = abscissa_of(key, levels);
  Chart chart{name + "_" + key.id(),
              name + " over " + key.name() +
                  ": means, one standard deviation up and down, and the single "
                  "cases (grey).",
              along.label, name};
  const double gap = std::numeric_limits<double>::quiet_NaN();
  Curve means, bars, cases;
  means.marker = Marker::dot;
  bars.line_width = 1.;
  cases.colour = "#9a9a9a";
  cases.line_width = 0.;
  cases.marker = Marker::ring;
  if (key.is_variant())
  {
    means.line_width = 0.;
    for (const Level &level : levels)
      chart.x_names.push_back(level.value);
  }
  for (const Level &level : levels)
  {
    const double x = along(level.x), mean = level.mean();
    if (!std::isfinite(mean))
      continue;
    means.x.push_back(x);
    means.y.push_back(mean);
    bars.x.insert(bars.x.end(), {x, x, gap});
    bars.y.insert(bars.y.end(),
                  {mean - level.deviation(), mean + level.deviation(), gap});
    for (const double sample : level.samples)
    {
      cases.x.push_back(x);
      cases.y.push_back(sample);
    }
  }
  if (means.x.empty())
    chart.notes.push_back("no case of this sweep gave " + name + ".");
  else
    chart.curves = {cases, bars, means};
  return chart;
}

/// The curves of all cases, a colour for every value of a key.
Chart curve_chart(const StudyData &data, std::size_t k, const fs::path &folder)
{
  const Study &study = data.study;
  Chart chart{"curve_" + study.keys[k].id(),
              study.curve_y + " over " + study.curve_x + " for values of " +
                  study.keys[k].name() + ", all seeds.",
              study.curve_x, study.curve_y};
  std::size_t n_levels = 0;
  for (const Level &level : levels_of(data, k, 0))
  {
    bool is_named = false;
    for (std::size_t p = 0; p < data.points.size(); ++p)
    {
      const fs::path history = folder / data.points[p].folder / "history.csv";
      if (data.points[p].values[k] != level.value || !is_in_sweep(data, p, k) ||
          !data.results[p].is_done || !fs::exists(history))
        continue;
      const Table table = read_table(history.string());
      const Column *x = table.find(study.curve_x),
                   *y = table.find(study.curve_y);
      if (x && y)
      {
        Curve curve;
        curve.name = is_named ? "" : level.value;
        curve.colour = palette_colour(n_levels);
        curve.dash = palette_dash(n_levels);
        curve.line_width = 0.9;
        is_named = true;
        curve.x = *x;
        curve.y = *y;
        chart.curves.push_back(curve);
      }
    }
    ++n_levels;
  }
  return chart;
}

std::string figure(const Chart &chart)
{
  if (chart.curves.empty())
    return "<p class=\"note\">Not drawn: " + escape(chart.id) + "</p>\n";
  return "<figure id=\"" + escape(chart.id) + "\">\n" + draw(chart) +
         "<figcaption>" + escape(chart.caption) + "</figcaption></figure>\n";
}

std::string row(const std::vector<std::string> &cells, const char *tag = "td")
{
  std::string out = "<tr>";
  for (const std::string &cell : cells)
    out += std::string("<") + tag + ">" + escape(cell) + "</" + tag + ">";
  return out + "</tr>\n";
}

std::string expectations(const StudyData &data)
{
  if (data.study.expectations.empty())
    return "";
  std::string out = "<section>\n<h2>Expectations</h2>\n<div class=\"wide\">"
                    "<table><thead>" +
                    row({"name", "expected", "shown", "means"}, "th") +
                    "</thead><tbody>\n";
  for (const Expectation &e : data.study.expectations)
  {
    const auto outcome = static_cast<std::size_t>(
        std::ranges::find(data.study.outcomes, e.outcome) -
        data.study.outcomes.begin());
    const auto key = static_cast<std::size_t>(
        std::ranges::find_if(data.study.keys, [&](const SweptKey &swept)
                             { return swept.name() == e.key; }) -
        data.study.keys.begin());
    const Verdict verdict = judge(levels_of(data, key, outcome), e.relation);
    out += row({e.name, e.outcome + " " + e.relation + " with " + e.key,
                verdict.is_shown ? "yes" : "no", verdict.numbers});
  }
  return out + "</tbody></table></div>\n</section>\n";
}

std::string failures(const StudyData &data)
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
  return rows.empty() ? ""
                      : "<section>\n<h2>Cases that failed</h2>\n<table>" +
                            rows + "</table>\n</section>\n";
}

std::string table(const StudyData &data)
{
  std::vector<std::string> head = {"run"};
  for (const SweptKey &key : data.study.keys)
    head.push_back(key.name());
  head.emplace_back("seed");
  head.insert(head.end(), data.study.outcomes.begin(),
              data.study.outcomes.end());
  std::string out = "<section>\n<h2>Cases</h2>\n<details><summary>" +
                    std::to_string(data.points.size()) +
                    " cases (study.csv)</summary><div class=\"wide\"><table>"
                    "<thead>" +
                    row(head, "th") + "</thead><tbody>\n";
  for (std::size_t p = 0; p < data.points.size(); ++p)
  {
    std::vector<std::string> cells = {data.points[p].folder};
    cells.insert(cells.end(), data.points[p].values.begin(),
                 data.points[p].values.end());
    cells.push_back(data.points[p].seed);
    for (const double value : data.results[p].outcomes)
      cells.push_back(format(value, 5));
    out += row(cells);
  }
  return out + "</tbody></table></div></details>\n</section>\n";
}
} // namespace

std::string study_page(const Study &study,
                       const std::vector<StudyPoint> &points,
                       const std::vector<PointResult> &results,
                       const fs::path &folder, const fs::path &figures)
{
  const StudyData data{study, points, results};
  std::string body = expectations(data) + failures(data);
  for (std::size_t k = 0; k < study.keys.size(); ++k)
  {
    body += "<section>\n<h2>" + escape(study.keys[k].name()) +
            "</h2>\n<div class=\"charts\">\n";
    std::vector<Chart> charts;
    if (!study.curve_x.empty())
      charts.push_back(curve_chart(data, k, folder));
    for (std::size_t o = 0; o < study.outcomes.size(); ++o)
      charts.push_back(level_chart(data, k, o));
    for (const Chart &chart : charts)
    {
      body += figure(chart);
      if (!figures.empty() && !chart.curves.empty())
        write_text(figures / (chart.id + ".svg"), svg_file(draw(chart)));
    }
    body += "</div>\n</section>\n";
  }
  return page_around(study.title, "Spall study of " + study.file,
                     body + table(data));
}
} // namespace spall
