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
constexpr double text_width = 7.2; ///< of a character [px]

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

std::vector<Tick> named_ticks(const std::vector<std::string> &names)
{
  std::vector<Tick> ticks;
  for (const std::string &name : names)
    ticks.push_back({static_cast<double>(ticks.size() + 1), name});
  return ticks;
}

/// Axis over one coordinate of all points of a chart.
template <class Coordinate>
Axis axis_of(const Chart &chart, const Coordinate &value_of, bool is_log, int n)
{
  Range range;
  for (const Curve &curve : chart.curves)
    for (std::size_t k = 0; k < curve.x.size(); ++k)
      if (const double value = value_of(curve, k); !is_log || value > 0.)
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

} // namespace

double text_width_of(const std::string &text)
{
  // Characters, not bytes.
  const auto n = std::count_if(text.begin(), text.end(),
                               [](char c) { return (c & 0xC0) != 0x80; });
  return text_width * static_cast<double>(n);
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

Frame::Frame(const Chart &chart)
    : x_axis(axis_of(
          chart,
          [](const Curve &curve, std::size_t k) { return curve.drawn_x(k); },
          chart.has_log_x, 6)),
      y_axis(axis_of(
          chart, [](const Curve &curve, std::size_t k) { return curve.y[k]; },
          chart.has_log_y, 5)),
      x_ticks(ticks_of(x_axis))
{
  if (!chart.x_names.empty())
  {
    x_ticks = named_ticks(chart.x_names);
    x_axis = {0.5, static_cast<double>(x_ticks.size()) + 0.5};
  }
  double widest = 0.;
  for (const Tick &tick : ticks_of(y_axis))
    widest = std::max(widest, text_width_of(tick.text));
  left = widest + 42.;
  if (chart.x_names.empty() && !x_ticks.empty())
    right = std::max(right, 0.5 * text_width_of(x_ticks.back().text) + 2.);
}

double Frame::x(double value) const
{
  return left + share_below(x_axis, value) * (chart_width - right - left);
}

double Frame::y(double value) const
{
  return top + plot_height * (1. - share_below(y_axis, value));
}

std::vector<LinePoint> Frame::line_points(const Curve &curve) const
{
  constexpr double nearest = 0.35; // [px]
  std::vector<LinePoint> points;
  bool is_pen_down = false;
  double last_x = 0., last_y = 0.;
  for (std::size_t k = 0; k < curve.x.size(); ++k)
  {
    const double at_x = x(curve.drawn_x(k)), at_y = y(curve.y[k]);
    if (!std::isfinite(at_x) || !std::isfinite(at_y))
    {
      is_pen_down = false;
      continue;
    }
    const bool is_last = k + 1 == curve.x.size();
    if (is_pen_down && !is_last &&
        std::hypot(at_x - last_x, at_y - last_y) < nearest)
      continue;
    points.push_back({k, !is_pen_down});
    is_pen_down = true;
    last_x = at_x;
    last_y = at_y;
  }
  return points;
}

std::vector<std::size_t> Frame::finite_rows(const Curve &curve) const
{
  std::vector<std::size_t> rows;
  for (std::size_t k = 0; k < curve.x.size(); ++k)
    if (std::isfinite(x(curve.drawn_x(k))) && std::isfinite(y(curve.y[k])))
      rows.push_back(k);
  return rows;
}

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

} // namespace spall
