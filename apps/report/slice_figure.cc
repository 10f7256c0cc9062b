#include "report/slice_figure.h"

#include "report/chart_table.h"
#include "report/figure_element.h"
#include "report/text.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <limits>
#include <set>

namespace spall
{
namespace
{
using Column = std::vector<double>;

// Sizes in px of the view box.
constexpr double panel = 300., gap = 20., left = 20., head = 26., foot = 22.,
                 row_head = 20.;
constexpr const char *particle_colour = "#d8d3ca", *edge_colour = "#6b6459",
                     *spalled_colour = "#d55e00", *space_colour = "#222";

/// One slices_*.csv.
struct SliceTable
{
  const char *title;
  Table table;
  const Column *height = nullptr, *particle = nullptr, *spalled = nullptr,
               *loop = nullptr, *x = nullptr, *y = nullptr;

  bool is_there() const { return y != nullptr && !y->empty(); }
  /// Whether a row begins another polygon than the one before.
  bool begins(std::size_t row) const
  {
    return row == 0 ||
           std::ranges::any_of(std::array{height, particle, spalled, loop},
                               [row](const Column *column) {
                                 return (*column)[row] != (*column)[row - 1];
                               });
  }
};

SliceTable read_slices(const RunData &run, const char *when, const char *title)
{
  SliceTable slices{title, {}};
  const std::filesystem::path path = std::filesystem::path(run.folder) /
                                     (std::string("slices_") + when + ".csv");
  if (!std::filesystem::exists(path))
    return slices;
  slices.table = read_table(path.string());
  slices.height = slices.table.find("height_share_1");
  slices.particle = slices.table.find("particle_1");
  slices.spalled = slices.table.find("spalled_1");
  slices.loop = slices.table.find("loop_1");
  slices.x = slices.table.find("x_m");
  if (slices.height && slices.particle && slices.spalled && slices.loop &&
      slices.x)
    slices.y = slices.table.find("y_m");
  return slices;
}

/// All tables in one scale.
struct SliceScale
{
  double low_x = std::numeric_limits<double>::infinity(), low_y = low_x;
  double high_x = -low_x, high_y = -low_x; ///< [m]

  void add(const SliceTable &slices)
  {
    for (const double x : *slices.x)
    {
      low_x = std::min(low_x, x);
      high_x = std::max(high_x, x);
    }
    for (const double y : *slices.y)
    {
      low_y = std::min(low_y, y);
      high_y = std::max(high_y, y);
    }
  }
  double width() const { return std::max(high_x - low_x, high_y - low_y); }
  double per_metre() const { return panel / width(); } ///< [px/m]
  double x(double at) const { return (at - low_x) * per_metre(); }
  double y(double at) const { return (high_y - at) * per_metre(); }
  double panel_height() const { return (high_y - low_y) * per_metre(); }
};

std::string px(double value)
{
  char text[32];
  std::snprintf(text, sizeof text, "%.2f", value);
  return text;
}

/// All polygons of a height that are of a sort, as the data of one path.
std::string path_of(const SliceTable &slices, const SliceScale &scale,
                    const std::function<bool(std::size_t row)> &is_wanted)
{
  std::string path;
  for (std::size_t row = 0; row < slices.y->size(); ++row)
  {
    if (!is_wanted(row))
      continue;
    const bool is_start = slices.begins(row);
    if (is_start && !path.empty())
      path += 'Z';
    path += is_start ? 'M' : 'L';
    path += px(scale.x((*slices.x)[row])) + " " + px(scale.y((*slices.y)[row]));
  }
  return path.empty() ? path : path + "Z";
}

std::string path_element(const std::string &path, const std::string &look)
{
  return path.empty() ? "" : "<path d=\"" + path + "\" " + look + "/>\n";
}

std::string text_element(double x, double y, const std::string &text,
                         const std::string &more = "")
{
  return "<text x=\"" + px(x) + "\" y=\"" + px(y) + "\" " + more + ">" +
         escape(text) + "</text>\n";
}

/// Particles, what they have lost, and the space that they lie in.
std::string draw_panel(const SliceTable &slices, const SliceScale &scale,
                       double height)
{
  const auto path = [&](bool is_space, bool is_spalled)
  {
    return path_of(slices, scale,
                   [&](std::size_t row)
                   {
                     return (*slices.height)[row] == height &&
                            ((*slices.particle)[row] < 0.) == is_space &&
                            ((*slices.spalled)[row] != 0.) == is_spalled;
                   });
  };
  const std::string round = "stroke-linejoin=\"round\" ";
  return path_element(path(false, false), round + "fill=\"" + particle_colour +
                                              "\" stroke=\"" + edge_colour +
                                              "\" stroke-width=\"0.5\"") +
         path_element(path(false, true), round + "fill=\"" + spalled_colour +
                                             "\" stroke=\"" + spalled_colour +
                                             "\" stroke-width=\"1\"") +
         path_element(path(true, false), "fill=\"none\" stroke=\"" +
                                             std::string(space_colour) +
                                             "\" stroke-width=\"1\"");
}

/// What summary.json says of a height; empty without it.
std::string spalled_text(const RunData &run, double height)
{
  const auto slices = run.summary.find("slices");
  if (slices == run.summary.end() || !slices->is_array())
    return "";
  for (const nlohmann::ordered_json &slice : *slices)
    if (number(slice, "height_share_1") == height)
      return "spalled: " + format(1e6 * number(slice, "spalled_area_m2"), 3) +
             " mm², " +
             format(100. * number(slice, "spalled_area_m2") /
                        (number(slice, "particle_area_m2") +
                         number(slice, "spalled_area_m2")),
                    2) +
             " %";
  return "";
}

/// A bar of 1, 2 or 5 times a power of ten, of at most a third of a panel.
std::string scale_bar(const SliceScale &scale, double x, double y)
{
  const double most = 1e3 * scale.width() / 3.; // [mm]
  const double decade = std::pow(10., std::floor(std::log10(most)));
  const double length = decade * (most >= 5. * decade   ? 5.
                                  : most >= 2. * decade ? 2.
                                                        : 1.);
  const double end = x + 1e-3 * length * scale.per_metre();
  return "<path d=\"M" + px(x) + " " + px(y) + "L" + px(end) + " " + px(y) +
         "\" stroke=\"" + space_colour + "\" stroke-width=\"2\"/>\n" +
         text_element(end + 6., y + 4., csv_number(length) + " mm");
}

std::string draw(const RunData &run, const std::vector<SliceTable> &states,
                 const std::vector<double> &heights, const std::string &spoken)
{
  SliceScale scale;
  for (const SliceTable &slices : states)
    scale.add(slices);
  const double row_height = scale.panel_height() + row_head + gap,
               width = 2. * left +
                       static_cast<double>(states.size()) * (panel + gap) - gap,
               total = head + row_height * static_cast<double>(heights.size()) +
                       foot;
  std::string out = "<svg viewBox=\"0 0 " + px(width) + " " + px(total) +
                    "\" role=\"img\" aria-label=\"" + escape(spoken) +
                    "\" font-family=\"Helvetica, Arial, 'Liberation Sans', "
                    "sans-serif\" font-size=\"12\" fill=\"#222\">\n";
  for (std::size_t k = 0; k < states.size(); ++k)
  {
    const double x = left + static_cast<double>(k) * (panel + gap);
    out += text_element(x, 16., states[k].title, "font-weight=\"bold\"");
    for (std::size_t row = 0; row < heights.size(); ++row)
    {
      const double y = head + row_height * static_cast<double>(row);
      out += text_element(x, y + 12., "z/H = " + format_fixed(heights[row], 2));
      if (k > 0)
        out += text_element(x + panel, y + 12., spalled_text(run, heights[row]),
                            "text-anchor=\"end\"");
      out += "<g transform=\"translate(" + px(x) + " " + px(y + row_head) +
             ")\">\n" + draw_panel(states[k], scale, heights[row]) + "</g>\n";
    }
  }
  return out + scale_bar(scale, left, total - 10.) + "</svg>\n";
}

void add_csv(int state, const SliceTable &slices, std::string &csv)
{
  char line[120];
  for (std::size_t row = 0; row < slices.y->size(); ++row)
  {
    std::snprintf(line, sizeof line, "%d,%g,%g,%g,%g,%.5g,%.5g\n", state,
                  (*slices.height)[row], (*slices.particle)[row],
                  (*slices.spalled)[row], (*slices.loop)[row], (*slices.x)[row],
                  (*slices.y)[row]);
    csv += line;
  }
}
} // namespace

SliceFigure slice_figure(const RunData &run, const std::string &id)
{
  SliceFigure figure;
  figure.id = id;
  std::vector<SliceTable> states;
  std::set<double, std::greater<>> heights; // the highest on top
  figure.csv = "end_1,height_share_1,particle_1,spalled_1,loop_1,x_m,y_m\n";
  int state = 0;
  for (const auto &[when, title] :
       {std::pair("start", "Start of loading"), std::pair("end", "End")})
  {
    SliceTable slices = read_slices(run, when, title);
    if (!slices.is_there())
      return figure;
    heights.insert(slices.height->begin(), slices.height->end());
    add_csv(state++, slices, figure.csv);
    states.push_back(std::move(slices));
  }
  figure.caption =
      "Horizontal slices of the specimen, where loading begins and at the end "
      "of the run, at shares z/H of its height. Grey: outlines of the "
      "particles, from their series. Orange: what they have lost; a mark is at "
      "least as wide as its line. The dark line is the boundary of the "
      "specimen.";
  figure.svg =
      draw(run, states, {heights.begin(), heights.end()}, figure.caption);
  return figure;
}

std::string html_figure(const SliceFigure &figure)
{
  return figure.svg.empty()
             ? ""
             : "<figure id=\"" + figure.id + "\">\n" + figure.svg +
                   "<figcaption>" + escape(figure.caption) + "</figcaption>\n" +
                   csv_link(figure.id + ".csv", figure.csv) + "</figure>\n";
}
} // namespace spall
