#include "commands/commands.h"
#include "errors.h"
#include "report/figures.h"
#include "report/page.h"
#include "report/render_ground.h"
#include "report/render_network.h"
#include "run/whole_file.h"

#include <algorithm>
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

/// One colour scale for all runs, so that they compare.
std::vector<Picture> draw_specimens(std::span<const RunData> runs)
{
  std::vector<std::vector<SpecimenFiles>> specimens;
  double max_loss = 0.;
  for (const RunData &run : runs)
  {
    specimens.push_back(find_specimens(run.folder));
    max_loss = std::max(max_loss, loss_scale(specimens.back()));
  }
  std::vector<Picture> pictures;
  for (const auto &files : specimens)
    pictures.push_back(files.empty()
                           ? Picture{"", "there is no frames/surfaces_*.vtu."}
                           : render_specimens(files, max_loss));
  return pictures;
}

/// One scale of forces and one of bulges for all runs.
std::vector<Picture> draw_networks(std::span<const RunData> runs)
{
  std::vector<std::vector<NetworkFiles>> networks;
  double max_force = 0., max_bulge = 0.;
  for (const RunData &run : runs)
  {
    networks.push_back(find_networks(run.folder));
    max_force = std::max(max_force, force_scale(networks.back()));
    max_bulge = std::max(max_bulge, bulge_scale(networks.back()));
  }
  std::vector<Picture> pictures;
  for (const auto &files : networks)
    pictures.push_back(files.empty()
                           ? Picture{"", "there is no frames/contacts_*.vtu."}
                           : render_network(files, max_force, max_bulge));
  return pictures;
}

/// One scale of settlements for all runs.
std::vector<Picture> draw_grounds(std::span<const RunData> runs)
{
  std::vector<std::vector<GroundFiles>> grounds;
  double max_settlement = 0.;
  for (const RunData &run : runs)
  {
    grounds.push_back(find_grounds(run.folder));
    max_settlement = std::max(max_settlement, settlement_scale(grounds.back()));
  }
  std::vector<Picture> pictures;
  for (const auto &files : grounds)
    pictures.push_back(files.empty() ? Picture{}
                                     : render_ground(files, max_settlement));
  return pictures;
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
  for (std::size_t k = 0; k < report.pictures.size(); ++k)
  {
    const std::string number =
        report.pictures.size() > 1 ? "_" + std::to_string(k + 1) : "";
    if (!report.pictures[k].png.empty())
      write_asked(folder / ("specimen" + number + ".png"),
                  report.pictures[k].png);
    if (!report.networks[k].png.empty())
      write_asked(folder / ("contacts" + number + ".png"),
                  report.networks[k].png);
    if (!report.grounds[k].png.empty())
      write_asked(folder / ("subgrade" + number + ".png"),
                  report.grounds[k].png);
  }
}
} // namespace

int report_command(Words words)
{
  const Options options = parse(words);
  const std::vector<RunData> runs = read_runs(options.folders);
  const Report report{runs, make_charts(runs), draw_specimens(runs),
                      draw_networks(runs), draw_grounds(runs)};
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
