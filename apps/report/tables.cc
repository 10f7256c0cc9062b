#include "report/tables.h"

#include "report/chart.h"
#include "report/chart_table.h"
#include "report/figure_element.h"
#include "report/kind_report.h"
#include "report/text.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

namespace spall
{
namespace
{
using Json = nlohmann::ordered_json;

std::string headline_value(const Headline &line, const RunData &run)
{
  const double value = line.value(run);
  const std::string sign = line.has_sign && value > 0. ? "+" : "";
  return sign + (line.is_count ? format_fixed(value, 0) : format(value, 3)) +
         (std::isfinite(value) ? line.unit : "");
}

std::string particles(const Json &summary)
{
  return text_of(summary, "n_particles") + " (" +
         text_of(summary, "n_breakable") + " breakable)";
}

/// Rows of every kind, before those of the kind.
std::vector<SummaryRow> first_rows()
{
  using enum ReportSection;
  return {text_row(input, "Title", "title"),
          {specimen, "Particles",
           [](const RunData &run) { return particles(run.summary); }},
          number_row(specimen, "Volume of solids (cm³)", "solid_volume_m3", 1e6,
                     4)};
}

/// Rows of every kind, after those of the kind: events, accuracy and cost.
std::vector<SummaryRow> last_rows()
{
  using enum ReportSection;
  return {text_row(breakage, "Breakage events (–)", "n_events"),
          number_row(energy, "Energy residual / external work (%)",
                     "energy_residual_ratio_1", 100., 2),
          number_row(energy, "Non-conservative work / external work (%)",
                     "non_conservative_work_ratio_1", 100., 2),
          number_row(network, "Largest overlap / radius (–)",
                     "overlap_over_radius_1", 1., 2),
          {boundaries, "Exchange gain / limit (–)",
           [](const RunData &run)
           {
             return number_pair(run.summary, "exchange_gain_1",
                                "exchange_gain_limit_1", 1.);
           }},
          number_row(boundaries, "Largest exchange gain of the run (–)",
                     "worst_gain_1", 1., 2),
          number_row(performance, "Time step (µs)", "time_step_s", 1e6),
          text_row(performance, "Steps (–)", "n_steps"),
          text_row(performance, "Threads (–)", "threads"),
          text_row(performance, "Version of Spall", "version")};
}

std::vector<SummaryRow> summary_rows(std::span<const RunData> runs)
{
  std::vector<SummaryRow> all = first_rows();
  for (const auto &more : {report_of(runs).rows, last_rows()})
    all.insert(all.end(), more.begin(), more.end());
  return all;
}

std::string cell(const std::string &text)
{
  return "<td>" + escape(text) + "</td>";
}

std::string head_row(std::span<const RunData> runs, const std::string &first)
{
  std::string out = "<thead><tr><th scope=\"col\">" + first + "</th>";
  for (const RunData &run : runs)
    out += "<th scope=\"col\">" + escape(run.name) + "</th>";
  return out + "</tr></thead>\n";
}

std::string first_cell(const std::string &text)
{
  return "<tr><th scope=\"row\">" + escape(text) + "</th>";
}

/// Phases of all runs in the order of their appearance, without the total.
std::vector<std::string> phases_of(std::span<const RunData> runs)
{
  std::vector<std::string> phases;
  for (const RunData &run : runs)
    if (const auto clock = run.summary.find("wall_clock_s");
        clock != run.summary.end() && clock->is_object())
      for (const auto &[phase, seconds] : clock->items())
        if (phase != "total" &&
            std::find(phases.begin(), phases.end(), phase) == phases.end())
          phases.push_back(phase);
  return phases;
}

/// [s]; NaN if the run has none.
double seconds(const RunData &run, const std::string &phase)
{
  const auto clock = run.summary.find("wall_clock_s");
  return clock != run.summary.end() && clock->is_object()
             ? number(*clock, phase)
             : std::numeric_limits<double>::quiet_NaN();
}

std::string time_cell(const RunData &run, const std::string &phase)
{
  const double time = seconds(run, phase), total = seconds(run, "total");
  if (!std::isfinite(time))
    return cell("–");
  const std::string share =
      total > 0. ? " (" + format_fixed(100. * time / total, 1) + " %)" : "";
  return cell(format_fixed(time, 1) + " s" + share);
}
} // namespace

std::string headline(std::span<const RunData> runs)
{
  std::string out;
  if (runs.size() == 1)
  {
    out = "<dl class=\"headline\">\n";
    for (const Headline &line : report_of(runs).headlines)
      out += "<div><dt>" + std::string(line.name) + "</dt><dd>" +
             headline_value(line, runs[0]) + "</dd></div>\n";
    return out + "</dl>\n";
  }
  out = "<div class=\"wide\"><table class=\"headline\">" +
        head_row(runs, "Run") + "<tbody>\n";
  for (const Headline &line : report_of(runs).headlines)
  {
    out += first_cell(line.name);
    for (const RunData &run : runs)
      out += cell(headline_value(line, run));
    out += "</tr>\n";
  }
  return out + "</tbody></table></div>\n";
}

std::string summary_table(std::span<const RunData> runs, ReportSection section)
{
  std::string rows;
  for (const SummaryRow &row : summary_rows(runs))
  {
    if (row.section != section)
      continue;
    std::string cells;
    bool has_value = false;
    for (const RunData &run : runs)
    {
      const std::string value = row.value(run);
      has_value =
          has_value || (value != "–" && value != "– / –" && value != "– → –");
      cells += cell(value);
    }
    if (has_value)
      rows += first_cell(row.name) + cells + "</tr>\n";
  }
  if (rows.empty())
    return "";
  return "<div class=\"wide\"><table>" +
         (runs.size() > 1 ? head_row(runs, "Run") : "") + "<tbody>\n" + rows +
         "</tbody></table></div>\n";
}

namespace
{
/// Seconds of every phase and run.
std::string wall_clock_csv(const ShareBar &bar)
{
  std::string csv = "run,phase,time_s\n";
  for (std::size_t row = 0; row < bar.rows.size(); ++row)
    for (std::size_t k = 0; k < bar.parts.size(); ++k)
      if (std::isfinite(bar.values[row][k]))
        csv += csv_cell(bar.rows[row]) + "," + csv_cell(bar.parts[k]) + "," +
               csv_number(bar.values[row][k]) + "\n";
  return csv;
}
} // namespace

std::string wall_clock(std::span<const RunData> runs)
{
  const std::vector<std::string> phases = phases_of(runs);
  if (phases.empty())
    return "";
  ShareBar bar{{}, phases, {}};
  for (const RunData &run : runs)
  {
    bar.rows.push_back(run.name);
    bar.values.emplace_back();
    for (const std::string &phase : phases)
      bar.values.back().push_back(seconds(run, phase));
  }
  std::string out = "<figure id=\"wall_clock\">\n" + draw(bar) +
                    "<figcaption>Wall-clock time of the run, split into the "
                    "phases of a step. The width of a field is its share of "
                    "the total.</figcaption>\n" +
                    csv_link("wall_clock.csv", wall_clock_csv(bar)) +
                    "</figure>\n<div class=\"wide\"><table>" +
                    head_row(runs, "Phase") + "<tbody>\n";
  for (std::size_t k = 0; k < phases.size(); ++k)
  {
    out += "<tr><th scope=\"row\"><span class=\"key\" style=\"background:" +
           palette_colour(k) + "\"></span>" + escape(phases[k]) + "</th>";
    for (const RunData &run : runs)
      out += time_cell(run, phases[k]);
    out += "</tr>\n";
  }
  out += "</tbody><tfoot>" + first_cell("total");
  for (const RunData &run : runs)
    out += time_cell(run, "total");
  return out + "</tr></tfoot></table></div>\n";
}
} // namespace spall
