#include "report/chart.h"
#include "report/figure_element.h"
#include "report/figure_parts.h"
#include "report/page_frame.h"
#include "report/text.h"
#include "run/quantity_name.h"
#include "run/whole_file.h"
#include "study/measured.h"
#include "study/profiles.h"
#include "study/tables.h"

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
/// Between series, over the range of the key [-].
constexpr double series_gap = 0.012;

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
  return {(is_wide ? "log10 of " : "") + key_label(key.name(), key.unit),
          is_wide};
}

/// Means with error bars of one standard deviation, and the single cases; all
/// of it to the right by a shift, so that series do not hide each other.
void add_levels(const std::vector<Level> &levels, const Abscissa &along,
                double shift, const Curve &look, Chart &chart)
{
  const double gap = std::numeric_limits<double>::quiet_NaN();
  Curve means = look, bars = look, cases = look;
  const std::string start = look.name.empty() ? "" : look.name + ", ";
  bars.name = cases.name = bars.dash = "";
  means.csv_name = start + "mean";
  bars.csv_name = start + "mean minus and plus one standard deviation";
  cases.csv_name = start + "single cases";
  means.shift = bars.shift = cases.shift = shift;
  means.marker = Marker::dot;
  bars.line_width = 1.;
  cases.line_width = 0.;
  cases.marker = Marker::ring;
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
  if (!means.x.empty())
    chart.curves.insert(chart.curves.end(), {cases, bars, means});
}

/// An outcome over a key, a colour for each series.
Chart level_chart(const StudyData &data, std::size_t k, std::size_t outcome)
{
  const SweptKey &key = data.study.keys[k];
  const std::string &name = data.study.outcomes[outcome];
  const std::vector<Level> levels = levels_of(data, Cut(k), outcome);
  const Abscissa along = abscissa_of(key, levels);
  const std::vector<Cut> series = series_of(data, k);
  Chart chart{name + "_" + key.id(), ReportSection::response,
              "Mean of " + quantity_name(name).words + " for each value of " +
                  key.name() +
                  " (dots), bars of one standard deviation up and down, and "
                  "single cases (rings)" +
                  (series.size() > 1
                       ? ", for the values of " +
                             data.study.keys[*series[0].where_key].name() +
                             ". Its curves are shifted sideways where they "
                             "would hide each other; the CSV is not."
                       : "."),
              along.label, axis_label(name)};
  if (key.is_variant())
    for (const Level &level : levels)
      chart.x_names.push_back(level.value);
  // Levels without a result are not on the axis.
  std::vector<Level> drawn = levels;
  std::erase_if(drawn, [](const Level &level)
                { return !std::isfinite(level.mean()); });
  const double gap =
      drawn.empty()
          ? 0.
          : series_gap * (along(drawn.back().x) - along(drawn.front().x));
  for (std::size_t n = 0; n < series.size(); ++n)
  {
    Curve look;
    look.colour = palette_colour(n);
    look.dash = palette_dash(n);
    if (key.is_variant())
      look.line_width = 0.;
    if (series[n].where_key)
      look.name = data.study.keys[*series[n].where_key].with_unit(
          series[n].where_value);
    const double offset =
        static_cast<double>(n) - 0.5 * static_cast<double>(series.size() - 1);
    add_levels(levels_of(data, series[n], outcome), along, offset * gap, look,
               chart);
  }
  if (chart.curves.empty())
    chart.notes.push_back("no case of this sweep gave " + name + ".");
  return chart;
}

/// Measured points in a style, as far as the curves go.
void add_measured(const MeasuredPoints &points, Curve dots, Chart &chart)
{
  double last = 0.;
  for (const Curve &curve : chart.curves)
    for (const double x : curve.x)
      last = std::max(last, x);
  dots.line_width = 0.;
  dots.marker = Marker::dot;
  dots.marker_size = 4.;
  for (std::size_t k = 0; k < points.x.size(); ++k)
    if (points.x[k] <= last)
    {
      dots.x.push_back(points.x[k]);
      dots.y.push_back(points.y[k]);
    }
  if (!dots.x.empty())
    chart.curves.push_back(dots);
}

/// The curves of all cases, a colour for every value of a key.
Chart curve_chart(const StudyData &data, std::size_t k, const fs::path &folder)
{
  const Study &study = data.study;
  Chart chart{"curve_" + study.keys[k].id(), ReportSection::response,
              "Curves of " + quantity_name(study.curve_y).words + " over " +
                  quantity_name(study.curve_x).words + " for the values of " +
                  study.keys[k].name() + ", one line for each case" +
                  (study.combine == Combine::grid && study.keys.size() > 1
                       ? "; the other keys have the values of the base case."
                       : ".") +
                  (study.measured.empty() ? "" : " Dots are measured values."),
              axis_label(study.curve_x), axis_label(study.curve_y)};
  std::size_t n_levels = 0;
  for (const Level &level : levels_of(data, Cut(k), 0))
  {
    bool is_named = false;
    for (const std::size_t p : drawn_cases(data, k, level.value))
    {
      const fs::path history = folder / data.points[p].folder / "history.csv";
      if (!fs::exists(history))
        continue;
      const Table table = read_table(history.string());
      const Column *x = table.find(study.curve_x),
                   *y = table.find(study.curve_y);
      if (x && y)
      {
        Curve curve;
        const std::string value = study.keys[k].with_unit(level.value);
        curve.name = is_named ? "" : value;
        curve.csv_name = value + ", " + data.points[p].folder;
        curve.colour = palette_colour(n_levels);
        curve.dash = palette_dash(n_levels);
        curve.line_width = 0.9;
        is_named = true;
        curve.x = *x;
        curve.y = *y;
        chart.curves.push_back(curve);
      }
    }
    Curve dots;
    dots.colour = palette_colour(n_levels);
    dots.csv_name = study.keys[k].with_unit(level.value) + ", measured";
    add_measured(measured_points(data, Cut(k), level.value), dots, chart);
    ++n_levels;
  }
  return chart;
}

/// Variants by name, values by their key.
std::string curve_name(const Study &study, const LevelCost &level)
{
  const SweptKey &key = study.keys[level.key];
  return key.is_variant() ? level.value : key.name();
}

/// Error against cost on logarithmic axes, a colour for every key, the Pareto
/// front as a line.
Chart cost_chart(const StudyData &data)
{
  Chart chart{"error_against_cost", ReportSection::response,
              "Largest error of any outcome, divided by the scatter of the "
              "seeds, and cost divided by that of the base case. The line is "
              "the Pareto front. Below the dashed line the error is less than "
              "half the scatter.",
              quantity_name(data.study.costs.front()).words +
                  " over that of the base case (–)",
              "worst error over the spread of seeds (–)"};
  chart.has_log_x = chart.has_log_y = true;
  Curve front, half;
  front.line_width = 1.;
  front.colour = "#555555";
  front.is_in_csv = false;
  half = front;
  half.dash = "5 4";
  std::vector<LevelCost> levels = level_costs(data);
  std::ranges::sort(levels, {}, &LevelCost::cost);
  for (const LevelCost &level : levels)
  {
    const std::string name = curve_name(data.study, level);
    auto curve = std::ranges::find(chart.curves, name, &Curve::name);
    if (curve == chart.curves.end())
    {
      Curve fresh;
      fresh.name = name;
      fresh.colour = palette_colour(chart.curves.size());
      fresh.line_width = 0.;
      fresh.marker =
          chart.curves.size() < palette_size ? Marker::dot : Marker::ring;
      curve = chart.curves.insert(curve, fresh);
    }
    curve->x.push_back(level.cost());
    curve->y.push_back(level.worst);
  }
  for (const LevelCost &level : levels)
  {
    half.x.push_back(level.cost());
    half.y.push_back(0.5);
    if (level.is_on_front)
    {
      front.x.push_back(level.cost());
      front.y.push_back(level.worst);
    }
  }
  chart.curves.push_back(front);
  chart.curves.push_back(half);
  return chart;
}

/// The chart in the page, and as a file of its own where figures are kept.
std::string figure(const Chart &chart, const fs::path &figures)
{
  if (chart.curves.empty())
    return html_notes({"Not drawn: " + chart.id});
  if (!figures.empty())
    write_text(figures / (chart.id + ".svg"), svg_file(draw(chart)));
  return html_figure(chart);
}

std::string noted_rows(const TextTable &table)
{
  return "<p>" + escape(table.note) + "</p>\n" + html_rows(table);
}

PageSection table_section(const TextTable &table, const std::string &more = "")
{
  return {section_id(table.title), table.title,
          table.rows.empty() ? "" : noted_rows(table) + more};
}

/// A table that is folded at first.
std::string folded(const TextTable &table, const std::string &summary)
{
  return "<details><summary>" + escape(summary) + "</summary>" +
         noted_rows(table) + "</details>\n";
}

PageSection key_section(const StudyData &data, std::size_t k,
                        const fs::path &folder, const fs::path &figures)
{
  const std::string name = data.study.keys[k].name();
  std::string body = "<div class=\"charts\">\n";
  if (!data.study.curve_x.empty())
    body += figure(curve_chart(data, k, folder), figures);
  for (const Profile &profile : data.study.profiles)
    body += figure(profile_chart(data, k, profile, folder), figures);
  for (std::size_t o = 0; o < data.study.outcomes.size(); ++o)
    body += figure(level_chart(data, k, o), figures);
  body += "</div>\n";
  if (const TextTable spread = spread_table(data, k); !spread.rows.empty())
    body += "<h3>" + escape(spread.title) + "</h3>\n" + noted_rows(spread);
  const TextTable differences = difference_table(data, k);
  return {section_id("key " + name), name,
          body + folded(differences, differences.title)};
}
} // namespace

std::string study_page(const StudyData &data, const fs::path &folder,
                       const fs::path &figures)
{
  const Study &study = data.study;
  std::vector<PageSection> sections = {table_section(expectation_table(data))};
  if (study.has_reference())
  {
    sections.push_back(
        table_section(cost_table(data), figure(cost_chart(data), figures)));
    sections.push_back(table_section(default_table(data)));
  }
  sections.push_back(table_section(failure_table(data)));
  for (std::size_t k = 0; k < study.keys.size(); ++k)
    sections.push_back(key_section(data, k, folder, figures));
  sections.push_back(
      {"cases", "Cases",
       folded(case_table(data),
              std::to_string(data.points.size()) + " cases (study.csv)")});
  return framed_page({study.title, "Spall study of " + study.file}, sections);
}
} // namespace spall
