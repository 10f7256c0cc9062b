#include "commands/commands.h"
#include "errors.h"
#include "report/figures.h"
#include "report/page.h"
#include "run/whole_file.h"

#include <filesystem>
#include <iostream>

namespace spall
{
namespace
{
namespace fs = std::filesystem;

struct Options
{
  std::vector<std::string> folders;
  std::string out;     ///< the page
  std::string figures; ///< folder for charts and pictures; empty: none
};

Options parse(Words words)
{
  Options options;
  for (std::size_t k = 0; k < words.size(); ++k)
  {
    const std::string &word = words[k];
    if (word == "--out" || word == "--figures")
    {
      if (k + 1 == words.size() || words[k + 1].starts_with("--"))
        throw InputError("report: " + word + " needs a " +
                         (word == "--out" ? "file" : "folder"));
      (word == "--out" ? options.out : options.figures) = words[++k];
    }
    else if (word.starts_with("-"))
      throw InputError("report: unknown option '" + word +
                       "' (allowed: --out FILE, --figures FOLDER)");
    else
      options.folders.push_back(word);
  }
  if (options.folders.empty())
    throw InputError("report: name at least one run folder (spall report DIR "
                     "[DIR ...] [--out FILE] [--figures FOLDER])");
  return options;
}

/// Of the runs that have slices; their ids are file names.
std::vector<SliceFigure> draw_slices(std::span<const RunData> runs)
{
  std::vector<SliceFigure> figures;
  for (const RunData &run : runs)
  {
    SliceFigure figure = slice_figure(
        run, runs.size() > 1
                 ? "slices_" + std::to_string(&run - runs.data() + 1)
                 : "slices");
    if (figure.svg.empty())
      continue;
    if (runs.size() > 1)
      figure.caption = run.name + ". " + figure.caption;
    figures.push_back(std::move(figure));
  }
  return figures;
}

void write_figures(const Report &report, const fs::path &folder)
{
  std::error_code error;
  fs::create_directories(folder, error);
  if (error)
    throw InputError("report: cannot make the folder '" + folder.string() +
                     "' (" + error.message() + ")");
  for (const Chart &chart : report.charts)
    if (!chart.curves.empty())
      write_asked(folder / (chart.id + ".svg"), svg_file(draw(chart)));
  for (const SliceFigure &figure : report.slices)
    write_asked(folder / (figure.id + ".svg"), svg_file(figure.svg));
  for (std::size_t k = 0; k < report.pictures.size(); ++k)
  {
    const std::string number =
        report.pictures.size() > 1 ? "_" + std::to_string(k + 1) : "";
    const auto write = [&](const std::string &name, const Picture &picture)
    {
      if (!picture.png.empty())
        write_asked(folder / (name + number + ".png"), picture.png);
    };
    write("specimen", report.pictures[k].specimen);
    write("contacts", report.pictures[k].network);
    write("subgrade", report.pictures[k].ground);
  }
}
} // namespace

int report_command(Words words)
{
  const Options options = parse(words);
  const std::vector<RunData> runs = read_runs(options.folders);
  const Report report{runs, make_charts(runs), draw_pictures(options.folders),
                      draw_slices(runs)};
  fs::path page = "report.html";
  if (!options.out.empty())
    page = options.out;
  else if (runs.size() == 1)
    page = fs::path(options.folders[0]) / "report.html";
  write_asked(page, make_page(report));
  if (!options.figures.empty())
    write_figures(report, options.figures);
  std::cout << page.string() << '\n';
  return 0;
}
} // namespace spall
