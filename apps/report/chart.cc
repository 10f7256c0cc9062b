#include "report/chart.h"

#include "report/text.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace spall
{
namespace
{
// Sizes in px of the view box; text 12 px is 9 pt at a width of 90 mm.
constexpr double width = 480., plot_height = 250., least_right = 16.,
                 bottom = 46.;
constexpr double text_width = 7.2, legend_row = 19., legend_key = 26.;
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

/// Characters, not bytes.
double width_of(const std::string &text)
{
  const auto n = std::count_if(text.begin(), text.end(),
                               [](char c) { return (c & 0xC0) != 0x80; });
  return text_width * static_cast<double>(n);
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
  return "<svg viewBox=\"0 0 " + px(width) + " " + px(height) +
         "\" role=\"img\" aria-label=\"" + escape(spoken) + "\" " + font +
         " fill=\"#222\">\n";
}

struct Range
{
  double low = std::numeric_limits<double>::infinity(), high = -low;
  void add(double value)
  {
    if (!std::isfinite(value))
      return;
    low = std::min(low, value);
    high = std::max(high, value);
  }
};

struct Tick
{
  double value;
  std::string text;
};

/// 10 to a power, as a power from a hundred and below a tenth on.
std::string decade_text(long exponent)
{
  if (exponent >= -1 && exponent <= 2)
    return format_fixed(std::pow(10., exponent), exponent < 0 ? 1 : 0);
  static const std::array<std::string, 10> digits{
      "\u2070", "\u00b9", "\u00b2", "\u00b3", "\u2074",
      "\u2075", "\u2076", "\u2077", "\u2078", "\u2079"};
  std::string text = exponent < 0 ? "10\u207b" : "10";
  for (const char digit : std::to_string(std::labs(exponent)))
    text += digits[static_cast<std::size_t>(digit - '0')];
  return text;
}

std::vector<Tick> decades_of(const Axis &axis)
{
  std::vector<Tick> ticks;
  for (long k = std::lround(axis.low); k <= std::lround(axis.high); ++k)
    ticks.push_back({std::pow(10., k), decade_text(k)});
  return ticks;
}

std::vector<Tick> ticks_of(const Axis &axis)
{
  if (axis.is_log)
    return decades_of(axis);
  // One rounding for the whole axis: 0.1 + 0.2 must not show.
  const int n_decimals =
      std::max(0, -static_cast<int>(std::floor(std::log10(axis.step) + 1e-9)));
  const bool is_plain = n_decimals <= 6 && std::abs(axis.high) < 1e7;
  const auto first = std::lround(std::ceil(axis.low / axis.step - 1e-6)),
             last = std::lround(std::floor(axis.high / axis.step + 1e-6));
  std::vector<Tick> ticks;
  for (long k = first; k <= last; ++k)
  {
    const double value = static_cast<double>(k) * axis.step;
    ticks.push_back(
        {value, is_plain ? format_fixed(value, n_decimals) : format(value, 3)});
  }
  return ticks;
}

std::vector<Tick> named_ticks(const std::vector<std::string> &names)
{
  std::vector<Tick> ticks;
  for (const std::string &name : names)
    ticks.push_back({static_cast<double>(ticks.size() + 1), name});
  return ticks;
}

Axis axis_of(const Chart &chart, std::vector<double> Curve::*values,
             bool is_log, int n)
{
  Range range;
  for (const Curve &curve : chart.curves)
    for (const double value : curve.*values)
      if (!is_log || value > 0.)
        range.add(value);
  return is_log ? decade_axis(range.low, range.high)
                : nice_axis(range.low, range.high, n);
}

/// Share of the axis below a value; not finite where it has no position.
double share_below(const Axis &axis, double value)
{
  const double position = axis.is_log ? std::log10(value) : value;
  return (position - axis.low) / (axis.high - axis.low);
}

/// Where the data go on the page.
class Frame
{
public:
  explicit Frame(const Chart &chart)
      : x_axis(axis_of(chart, &Curve::x, chart.has_log_x, 6)),
        y_axis(axis_of(chart, &Curve::y, chart.has_log_y, 5)),
        x_ticks(ticks_of(x_axis))
  {
    if (!chart.x_names.empty())
    {
      x_ticks = named_ticks(chart.x_names);
      x_axis = {0.5, static_cast<double>(x_ticks.size()) + 0.5};
    }
    double widest = 0.;
    for (const Tick &tick : ticks_of(y_axis))
      widest = std::max(widest, width_of(tick.text));
    left = widest + 42.;
    if (chart.x_names.empty() && !x_ticks.empty())
      right = std::max(right, 0.5 * width_of(x_ticks.back().text) + 2.);
  }

  double x(double value) const
  {
    return left + share_below(x_axis, value) * (width - right - left);
  }
  double y(double value) const
  {
    return top + plot_height * (1. - share_below(y_axis, value));
  }
  double floor() const { return top + plot_height; }

  Axis x_axis, y_axis;
  std::vector<Tick> x_ticks;
  double left = 60., right = least_right, top = 10.;
};

std::string draw_axes(const Chart &chart, const Frame &frame)
{
  std::string out;
  const std::string grid = "stroke=\"#e4e4e4\" stroke-width=\"0.8\"",
                    ink = "stroke=\"#444\" stroke-width=\"1\" fill=\"none\"";
  for (const Tick &tick : ticks_of(frame.y_axis))
  {
    const double y = frame.y(tick.value);
    out += line(frame.left, y, width - frame.right, y, grid);
    out += label(frame.left - 7., y + 4., tick.text, "text-anchor=\"end\"");
  }
  for (const Tick &tick : frame.x_ticks)
  {
    const double x = frame.x(tick.value);
    out += line(x, frame.floor(), x, frame.floor() + 4., ink);
    out += label(x, frame.floor() + 17., tick.text, "text-anchor=\"middle\"");
  }
  out += line(frame.left, frame.top, frame.left, frame.floor(), ink);
  out +=
      line(frame.left, frame.floor(), width - frame.right, frame.floor(), ink);
  const double x_middle = (frame.left + width - frame.right) / 2.,
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

/// Points closer than a third of a pixel to the last one are left out.
std::string draw_line(const Curve &curve, const Frame &frame)
{
  std::string path;
  bool is_pen_down = false;
  double last_x = 0., last_y = 0.;
  for (std::size_t k = 0; k < curve.x.size(); ++k)
  {
    const double x = frame.x(curve.x[k]), y = frame.y(curve.y[k]);
    if (!std::isfinite(x) || !std::isfinite(y))
    {
      is_pen_down = false;
      continue;
    }
    const bool is_last = k + 1 == curve.x.size();
    if (is_pen_down && !is_last && std::hypot(x - last_x, y - last_y) < 0.35)
      continue;
    path += (is_pen_down ? "L" : "M") + px(x) + " " + px(y);
    is_pen_down = true;
    last_x = x;
    last_y = y;
  }
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
  for (std::size_t k = 0; k < curve.x.size(); ++k)
  {
    const double x = frame.x(curve.x[k]), y = frame.y(curve.y[k]);
    if (std::isfinite(x) && std::isfinite(y))
      out += draw_marker(x, y, curve);
  }
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
    const double entry = legend_key + width_of(curve.name) + 16.;
    if (x > frame.left && x + entry - 16. > width - frame.right)
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

Axis nice_axis(double low, double high, int n)
{
  if (!(low <= high))
    return {};
  // Round-off of a constant is no variation.
  const double size = std::max(std::abs(low), std::abs(high));
  if (high - low <= 1e-9 * size || high == low)
  {
    const double margin = size > 0. ? 0.1 * size : 1.;
    low -= margin;
    high += margin;
  }
  if (low > 0. && low < 0.4 * high)
    low = 0.;
  if (high < 0. && high > 0.4 * low)
    high = 0.;
  const double rough = (high - low) / n;
  const double decade = std::pow(10., std::floor(std::log10(rough)));
  const double digit = rough / decade;
  const double step = decade * (digit <= 1.1   ? 1.
                                : digit <= 2.2 ? 2.
                                : digit <= 5.5 ? 5.
                                               : 10.);
  // To the next tick, or, if that is far, a little beyond the data.
  constexpr double far = 0.55;
  const double margin = 0.2 * step;
  double from = std::floor(low / step + 1e-6) * step,
         to = std::ceil(high / step - 1e-6) * step;
  if (low - from > far * step && from != 0.)
    from = low - margin;
  if (to - high > far * step && to != 0.)
    to = high + margin;
  return {from, to, step};
}

Axis decade_axis(double low, double high)
{
  if (!(low <= high))
    return {0., 1., 1., true};
  const double from = std::floor(std::log10(low) + 1e-9),
               to = std::ceil(std::log10(high) - 1e-9);
  return {from, std::max(to, from + 1.), 1., true};
}

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
      out += rectangle(x, y, width * value / total, palette_colour(k));
      x += width * value / total;
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
