#include "report/page.h"

#include "report/tables.h"
#include "report/text.h"

namespace spall
{
namespace
{
constexpr const char *style = R"(
:root { color-scheme: light; }
body { font: 16px/1.5 system-ui, -apple-system, "Segoe UI", Roboto, Helvetica,
  Arial, sans-serif; color: #1c1c1c; background: #fff; max-width: 68rem;
  margin: 0 auto; padding: 1.5rem 1.25rem 4rem; }
h1 { font-size: 1.7rem; line-height: 1.25; margin: 0 0 .2rem; }
h2 { font-size: 1.2rem; margin: 2.4rem 0 .8rem; padding-bottom: .25rem;
  border-bottom: 1px solid #d8d8d8; }
.from { color: #555; margin: 0 0 1.4rem; overflow-wrap: anywhere; }
dl.headline { display: grid; gap: 1rem; margin: 0;
  grid-template-columns: repeat(auto-fit, minmax(13rem, 1fr)); }
dl.headline div { border: 1px solid #d8d8d8; border-radius: 6px;
  padding: .8rem 1rem; }
dl.headline dt { color: #444; font-size: .95rem; }
dl.headline dd { margin: .1rem 0 0; font-size: 2rem; line-height: 1.2;
  font-variant-numeric: tabular-nums; }
table { border-collapse: collapse; font-variant-numeric: tabular-nums;
  font-size: .95rem; }
table.headline { font-size: 1.1rem; }
th, td { text-align: left; padding: .3rem 1.4rem .3rem 0;
  border-bottom: 1px solid #e8e8e8; vertical-align: top; }
th { font-weight: 500; color: #444; } thead th, tfoot th, tfoot td {
  font-weight: 600; color: #1c1c1c; }
.wide { overflow-x: auto; }
.charts { display: grid; gap: 1.6rem 2rem;
  grid-template-columns: repeat(auto-fit, minmax(min(26rem, 100%), 1fr)); }
figure { margin: 0 0 .6rem; } figure svg, figure img { max-width: 100%;
  height: auto; display: block; } figure svg { width: 100%; }
figcaption { font-size: .9rem; color: #333; margin-top: .4rem; }
.warnings { border: 2px solid #a40000; border-radius: 6px; color: #7a0000;
  background: #fff2f0; padding: .6rem 1rem; margin: 1rem 0; }
.warnings p { margin: .2rem 0; }
.note { color: #7a4a00; font-size: .9rem; margin: .2rem 0; }
.key { display: inline-block; width: .8em; height: .8em; margin-right: .5em; }
details { margin: .6rem 0; } summary { cursor: pointer; }
pre { font: .8rem/1.45 ui-monospace, Menlo, Consolas, monospace;
  background: #f6f6f6; padding: 1rem; overflow-x: auto; }
@media print { .key { print-color-adjust: exact;
  -webkit-print-color-adjust: exact; }
  body { max-width: none; padding: 0; font-size: 10pt; }
  .charts { grid-template-columns: 1fr 1fr; }
  figure, tr, dl.headline div { break-inside: avoid; }
  h2 { break-after: avoid; } }
)";

std::string title_of(std::span<const RunData> runs)
{
  if (runs.size() > 1)
    return "Comparison of " + std::to_string(runs.size()) + " runs";
  const auto title = runs[0].summary.find("title");
  return title != runs[0].summary.end() && title->is_string()
             ? title->get<std::string>()
             : runs[0].name;
}

std::string notes(const std::vector<std::string> &lines)
{
  std::string out;
  for (const std::string &line : lines)
    out += "<p class=\"note\">" + escape(line) + "</p>\n";
  return out;
}

/// What summary.json warns of, at the top of the page; empty: nothing.
std::string warnings(std::span<const RunData> runs)
{
  std::string lines;
  for (const RunData &run : runs)
  {
    const auto list = run.summary.find("warnings");
    if (list == run.summary.end() || !list->is_array())
      continue;
    for (const auto &warning : *list)
      if (warning.is_string())
        lines += "<p>" +
                 escape((runs.size() > 1 ? run.name + ": " : "") +
                        "Warning: " + warning.get<std::string>()) +
                 "</p>\n";
  }
  return lines.empty()
             ? ""
             : "<div class=\"warnings\" role=\"alert\">\n" + lines + "</div>\n";
}

std::string header(std::span<const RunData> runs)
{
  std::string names;
  for (const RunData &run : runs)
    names += (names.empty() ? "" : ", ") + escape(run.name);
  std::string out = "<header>\n<h1>" + escape(title_of(runs)) +
                    "</h1>\n<p class=\"from\">Spall report of " + names +
                    "</p>\n" + warnings(runs) + headline(runs);
  for (const RunData &run : runs)
    for (const std::string &note : run.notes)
      out += notes({runs.size() > 1 ? run.name + ": " + note : note});
  return out + "</header>\n";
}

constexpr const char *specimen_caption =
    "Particles by their true surfaces, coloured by the share of their mass "
    "that "
    "they have lost; 98 % of the particles lie within the colour bar. The "
    "membrane or plate, if there is one, is half transparent.";

constexpr const char *network_caption =
    "Contacts as lines from centre to centre or to the boundary, as thick as "
    "their normal force; 99 % of the contacts lie within the colour bar. A "
    "membrane is coloured by how far it has come outward of where it was put.";

constexpr const char *ground_caption =
    "The subgrade behind the section through its middle, coloured by how far "
    "it has settled since its first frame and bent by many times that. The "
    "plate is where it is.";

std::string figure_of(const Report &report, std::size_t k,
                      const Picture &picture, const std::string &caption)
{
  if (picture.png.empty())
    return notes(
        {"No picture of " + report.runs[k].name + ": " + picture.problem});
  const std::string text = escape(
      (report.runs.size() > 1 ? report.runs[k].name + ". " : "") + caption);
  return "<figure><img alt=\"" + text + "\" width=\"" +
         std::to_string(picture.width / 2) + "\" src=\"data:image/png;base64," +
         base64(picture.png) + "\"><figcaption>" + text +
         "</figcaption></figure>\n";
}

std::string specimens(const Report &report)
{
  std::string out = "<section>\n<h2>Specimen</h2>\n";
  for (std::size_t k = 0; k < report.pictures.size(); ++k)
  {
    out += figure_of(report, k, report.pictures[k], specimen_caption);
    // What is missing has been reported once.
    if (!report.networks[k].png.empty())
      out += figure_of(report, k, report.networks[k], network_caption);
    if (!report.grounds[k].png.empty())
      out += figure_of(report, k, report.grounds[k], ground_caption);
  }
  return out + "</section>\n";
}

std::string curves(const std::vector<Chart> &charts)
{
  std::string out = "<section>\n<h2>Results</h2>\n<div class=\"charts\">\n";
  std::vector<std::string> missing;
  for (const Chart &chart : charts)
    if (chart.curves.empty())
      for (const std::string &note : chart.notes)
        missing.push_back("Not drawn: " + chart.id + " (" + note + ")");
    else
      out += "<figure id=\"" + chart.id + "\">\n" + draw(chart) +
             "<figcaption>" + escape(chart.caption) + "</figcaption>\n" +
             notes(chart.notes) + "</figure>\n";
  return out + "</div>\n" + notes(missing) + "</section>\n";
}

std::string parameters(std::span<const RunData> runs)
{
  std::string out = "<section>\n<h2>Parameters</h2>\n";
  for (const RunData &run : runs)
    if (!run.case_text.empty())
      out += "<details><summary>Resolved case of " + escape(run.name) +
             " (case.prm)</summary>\n<pre>" + escape(run.case_text) +
             "</pre></details>\n";
  return out + "</section>\n";
}
} // namespace

std::string page_around(const std::string &title, const std::string &from,
                        const std::string &body)
{
  return "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n"
         "<meta charset=\"utf-8\">\n"
         "<meta name=\"viewport\" content=\"width=device-width, "
         "initial-scale=1\">\n<title>" +
         escape(title) + "</title>\n<style>" + style +
         "</style>\n</head>\n<body>\n<header>\n<h1>" + escape(title) +
         "</h1>\n<p class=\"from\">" + escape(from) + "</p>\n</header>\n" +
         "<main>\n" + body + "</main>\n</body>\n</html>\n";
}

std::string make_page(const Report &report)
{
  const std::string title = escape(title_of(report.runs));
  return "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n"
         "<meta charset=\"utf-8\">\n"
         "<meta name=\"viewport\" content=\"width=device-width, "
         "initial-scale=1\">\n<title>" +
         title + "</title>\n<style>" + style + "</style>\n</head>\n<body>\n" +
         header(report.runs) + "<main>\n" + specimens(report) +
         curves(report.charts) + "<section>\n<h2>Summary</h2>\n" +
         summary_table(report.runs) +
         "</section>\n<section>\n<h2>Wall-clock time</h2>\n" +
         wall_clock(report.runs) + "</section>\n" + parameters(report.runs) +
         "</main>\n</body>\n</html>\n";
}
} // namespace spall
