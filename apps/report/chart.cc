#include "report/chart.h"

#include "report/chart_frame.h"
#include "report/text.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace spall
{
namespace
{
// Sizes in px of the view box.
constexpr double bottom = 46., legend_row = 19., legend_key = 26.;
constexpr const char *font =
    "font-family=\"Helvetica, Arial, 'Liberation Sans', sans-serif\" "
    "font-size=\"12\"";

std::string px(double value)
{
  std::string text = format_fixed(value, 1);
  // Paths need a plain minus.
  if (const auto position = text.find("\u2212"); position != std::string::npos)
    text.replace(position, std::string("\u2212").size(), "-");
  return text;
}

std::string label(double x, double y, const std::string &text,
                  const std::string &more)
{
  return "<text x=\"" + px(x) + "\" y=\"" + px(y) + "\" " + more + ">" +
         escape(text) + "</text>\n";
}

std::string line(double x1, double y1, double x2, double y2,
                 const std::string &more)
{
  return "<path d=\"M" + px(x1) + " " + px(y1) + "L" + px(x2) + " " + px(y2) +
         "\" " + more + "/>\n";
}

std::string rectangle(double x, double y, double w, const std::string &colour)
{
  return "<rect x=\"" + px(x) + "\" y=\"" + px(y) + "\" width=\"" + px(w) +
         "\" height=\"22\" fill=\"" + colour + "\"/>\n";
}

std::string open_svg(double height, const std::string &spoken)
{
  return "<svg viewBox=\"0 0 " + px(chart_width) + " " + px(height) +
         "\" role=\"img\" aria-label=\"" + escape(spoken) + "\" " + font +
         " fill=\"#222\">\n";
}

std::string draw_axes(const Chart &chart, const Frame &frame)
{
  std::string out;
  const std::string grid = "stroke=\"#e4e4e4\" stroke-width=\"0.8\"",
                    ink = "stroke=\"#444\" stroke-width=\"1\" fill=\"none\"";
  for (const Tick &tick : ticks_of(frame.y_axis))
  {
    const double y = frame.y(tick.value);
    out += line(frame.left, y, chart_width - frame.right, y, grid);
    out += label(frame.left - 7., y + 4., tick.text, "text-anchor=\"end\"");
  }
  for (const Tick &tick : frame.x_ticks)
  {
    const double x = frame.x(tick.value);
    out += line(x, frame.floor(), x, frame.floor() + 4., ink);
    out += label(x, frame.floor() + 17., tick.text, "text-anchor=\"middle\"");
  }
  out += line(frame.left, frame.top, frame.left, frame.floor(), ink);
  out += line(frame.left, frame.floor(), chart_width - frame.right,
              frame.floor(), ink);
  const double x_middle = (frame.left + chart_width - frame.right) / 2.,
               y_middle = frame.top + plot_height / 2.;
  out += label(x_middle, frame.floor() + 37., chart.x_label,
               "text-anchor=\"middle\"");
  out += label(14., y_middle, chart.y_label,
               "text-anchor=\"middle\" transform=\"rotate(-90 14.0 " +
                   px(y_middle) + ")\"");
  return out;
}

std::string stroke(const Curve &curve)
{
  std::string out = "fill=\"none\" stroke=\"" + curve.colour +
                    "\" stroke-width=\"" + px(curve.line_width) +
                    "\" stroke-linejoin=\"round\"";
  if (!curve.dash.empty())
    out += " stroke-dasharray=\"" + curve.dash + "\"";
  return out;
}

std::string draw_line(const Curve &curve, const Frame &frame)
{
  std::string path;
  for (const LinePoint &point : frame.line_points(curve))
    path += (point.is_start ? "M" : "L") +
            px(frame.x(curve.drawn_x(point.row))) + " " +
            px(frame.y(curve.y[point.row]));
  return path.empty() ? ""
                      : "<path d=\"" + path + "\" " + stroke(curve) + "/>\n";
}

std::string draw_marker(double x, double y, const Curve &curve)
{
  const std::string position = "<circle cx=\"" + px(x) + "\" cy=\"" + px(y) +
                               "\" r=\"" + px(curve.marker_size);
  if (curve.marker == Marker::ring)
    return position + "\" fill=\"#fff\" stroke=\"" + curve.colour +
           "\" stroke-width=\"0.9\"/>\n";
  return position + "\" fill=\"" + curve.colour + "\"/>\n";
}

std::string draw_curve(const Curve &curve, const Frame &frame)
{
  std::string out;
  if (curve.line_width > 0.)
    out += draw_line(curve, frame);
  if (curve.marker == Marker::none)
    return out;
  for (const std::size_t k : frame.finite_rows(curve))
    out += draw_marker(frame.x(curve.drawn_x(k)), frame.y(curve.y[k]), curve);
  return out;
}

/// Draws the entries row by row from `left`; moves the top of the plot down.
std::string draw_legend(const Chart &chart, Frame &frame)
{
  const auto n_named =
      std::count_if(chart.curves.begin(), chart.curves.end(),
                    [](const Curve &c) { return !c.name.empty(); });
  if (n_named < 2)
    return "";
  std::string out;
  double x = frame.left, y = 12.;
  for (const Curve &curve : chart.curves)
  {
    if (curve.name.empty())
      continue;
    const double entry = legend_key + text_width_of(curve.name) + 16.;
    if (x > frame.left && x + entry - 16. > chart_width - frame.right)
    {
      x = frame.left;
      y += legend_row;
    }
    if (curve.line_width > 0.)
      out += line(x, y, x + legend_key - 6., y, stroke(curve));
    if (curve.marker != Marker::none)
      out += draw_marker(x + (legend_key - 6.) / 2., y, curve);
    out += label(x + legend_key, y + 4., curve.name, "");
    x += entry;
  }
  frame.top = y + 16.;
  return out;
}
} // namespace

std::string palette_colour(std::size_t k)
{
  static const std::array<std::string, palette_size> colours{
      "#0072B2", "#D55E00", "#009E73", "#CC79A7",
      "#E69F00", "#56B4E9", "#222222", "#8C6D31"};
  return colours[k % colours.size()];
}

std::string palette_dash(std::size_t k)
{
  static const std::array<std::string, 4> dashes{"", "7 3", "2 2.5", "8 3 2 3"};
  return dashes[k % dashes.size()];
}

std::string draw(const Chart &chart)
{
  Frame frame(chart);
  const std::string legend = draw_legend(chart, frame);
  std::string out = open_svg(frame.floor() + bottom, chart.caption);
  out += draw_axes(chart, frame);
  for (const Curve &curve : chart.curves)
    out += draw_curve(curve, frame);
  return out + legend + "</svg>\n";
}

std::string draw(const ShareBar &bar)
{
  const bool has_names = bar.rows.size() > 1;
  const double row_height = has_names ? 46. : 30.;
  std::string out = open_svg(static_cast<double>(bar.rows.size()) * row_height,
                             "Shares of the wall-clock time");
  for (std::size_t row = 0; row < bar.rows.size(); ++row)
  {
    double total = 0., x = 0.;
    for (const double value : bar.values[row])
      total += std::isfinite(value) ? value : 0.;
    double y = static_cast<double>(row) * row_height + 4.;
    if (has_names)
      out += label(0., y + 10., bar.rows[row], "");
    y += has_names ? 16. : 0.;
    for (std::size_t k = 0; k < bar.values[row].size() && total > 0.; ++k)
    {
      const double value = bar.values[row][k];
      if (!std::isfinite(value) || value <= 0.)
        continue;
      out += rectangle(x, y, chart_width * value / total, palette_colour(k));
      x += chart_width * value / total;
    }
  }
  return out + "</svg>\n";
}

std::string svg_file(const std::string &element)
{
  // Only a file needs the name space; a page must not name any address.
  const std::string root = "<svg ";
  return "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n" + root +
         "xmlns=\"http://www.w3.org/2000/svg\" " + element.substr(root.size());
}
} // namespace spall
