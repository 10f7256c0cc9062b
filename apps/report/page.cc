#include "report/page.h"

#include "report/figure_element.h"
#include "report/page_frame.h"
#include "report/section.h"
#include "report/tables.h"
#include "report/text.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>

namespace spall
{
namespace
{
std::string title_of(std::span<const RunData> runs)
{
  if (runs.size() > 1)
    return "Comparison of " + std::to_string(runs.size()) + " runs";
  const auto title = runs[0].summary.find("title");
  return title != runs[0].summary.end() && title->is_string()
             ? title->get<std::string>()
             : runs[0].name;
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

PageHead head_of(std::span<const RunData> runs)
{
  PageHead head{title_of(runs), "Spall report of "};
  for (const RunData &run : runs)
    head.from += (&run == &runs[0] ? "" : ", ") + run.name;
  head.summary = warnings(runs) + headline(runs);
  for (const RunData &run : runs)
    for (const std::string &note : run.notes)
      head.summary +=
          html_notes({runs.size() > 1 ? run.name + ": " + note : note});
  return head;
}

/// Pictures of one sort, one for each run.
struct PictureSort
{
  ReportSection section;
  Picture RunPictures::*picture;
  const char *caption;
};

constexpr std::array picture_sorts = {
    PictureSort{
        ReportSection::specimen, &RunPictures::specimen,
        "Particles with their surfaces, at the start and at the end. The "
        "colour is the share of its mass that a particle has lost; 98 % of the "
        "particles lie within the colour bar. A membrane or plate is half "
        "transparent."},
    PictureSort{
        ReportSection::network, &RunPictures::network,
        "Contact network: a line from centre to centre, or to the boundary, "
        "for each contact. Its width and colour are the normal force; 99 % of "
        "the contacts lie within the colour bar. The colour of a membrane is "
        "its outward displacement from its initial position."},
    PictureSort{ReportSection::boundaries, &RunPictures::ground,
                "Subgrade behind the vertical section through its middle. The "
                "colour is the settlement since the first frame; displacements "
                "are magnified. The plate is at its true position."}};

std::string picture_figure(const Report &report, std::size_t k,
                           const Picture &picture, const std::string &caption)
{
  if (picture.png.empty())
    return "";
  const std::string text = escape(
      (report.runs.size() > 1 ? report.runs[k].name + ". " : "") + caption);
  return "<figure><img alt=\"" + text + "\" width=\"" +
         std::to_string(picture.width / 2) + "\" src=\"data:image/png;base64," +
         base64(picture.png) + "\"><figcaption>" + text +
         "</figcaption></figure>\n";
}

std::string pictures_of(const Report &report, ReportSection section)
{
  std::string out;
  for (const PictureSort &sort : picture_sorts)
    if (sort.section == section)
      for (std::size_t k = 0; k < report.pictures.size(); ++k)
        out += picture_figure(report, k, report.pictures[k].*sort.picture,
                              sort.caption);
  return out;
}

std::string charts_of(const Report &report, ReportSection section)
{
  std::string out;
  for (const Chart &chart : report.charts)
    if (chart.section == section && !chart.curves.empty())
      out += html_figure(chart);
  return out.empty() ? "" : "<div class=\"charts\">\n" + out + "</div>\n";
}

std::string quoted(const std::string &path)
{
  return path.find_first_of(" '") == std::string::npos ? path
                                                       : "\"" + path + "\"";
}

/// The command that repeats a run from its resolved case.
std::string command_of(const RunData &run)
{
  const double threads = number(run.summary, "threads"),
               ranks = number(run.summary, "ranks");
  const std::filesystem::path given = run.folder;
  const std::string folder =
      (given.has_filename() ? given : given.parent_path()).string();
  return (ranks > 1. ? "mpirun -n " + format_fixed(ranks, 0) + " " : "") +
         "spall run " + quoted(folder + "/case.prm") + " --out " +
         quoted(folder + "_repeated") +
         (std::isfinite(threads) ? " --threads " + format_fixed(threads, 0)
                                 : "");
}

std::string cases(const Report &report)
{
  std::string out;
  for (const RunData &run : report.runs)
    if (!run.case_text.empty())
      out += "<p>Command that repeats the run " + escape(run.name) +
             " from its resolved case:</p>\n<pre>" + escape(command_of(run)) +
             "</pre>\n<details><summary>Resolved case of " + escape(run.name) +
             " (case.prm): every parameter of the run</summary>\n<pre>" +
             escape(run.case_text) + "</pre></details>\n";
  return out;
}

std::string slices_of(const Report &report)
{
  std::string out;
  for (const SliceFigure &figure : report.slices)
    out += html_figure(figure);
  return out;
}

/// Figures that the page lacks, and why.
std::string missing_figures(const Report &report)
{
  std::vector<std::string> lines;
  for (std::size_t k = 0; k < report.pictures.size(); ++k)
    if (report.pictures[k].specimen.png.empty())
      lines.push_back("No picture of " + report.runs[k].name + ": " +
                      report.pictures[k].specimen.problem);
  for (const Chart &chart : report.charts)
    if (chart.curves.empty())
      for (const std::string &note : chart.notes)
        lines.push_back("Not drawn: " + chart.id + " (" + note + ")");
  return lines.empty() ? ""
                       : "<details><summary>Figures without data</summary>\n" +
                             html_notes(lines) + "</details>\n";
}

/// What a section has besides its rows, pictures and charts.
struct SectionPart
{
  ReportSection section;
  std::string (*make)(const Report &report);
};

constexpr std::array section_parts = {
    SectionPart{ReportSection::breakage, slices_of},
    SectionPart{ReportSection::performance,
                [](const Report &report) { return wall_clock(report.runs); }},
    SectionPart{ReportSection::input, cases},
    SectionPart{ReportSection::input, missing_figures}};

std::string parts_of(const Report &report, ReportSection section)
{
  std::string out;
  for (const SectionPart &part : section_parts)
    if (part.section == section)
      out += part.make(report);
  return out;
}
} // namespace

std::string make_page(const Report &report)
{
  std::vector<PageSection> sections;
  for (std::size_t k = 0; k < section_headings.size(); ++k)
  {
    const auto section = static_cast<ReportSection>(k);
    sections.push_back(
        {section_headings[k].id, section_headings[k].title,
         summary_table(report.runs, section) + pictures_of(report, section) +
             charts_of(report, section) + parts_of(report, section)});
  }
  return framed_page(head_of(report.runs), sections);
}
} // namespace spall
