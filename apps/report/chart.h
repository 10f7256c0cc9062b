#pragma once

#include "report/section.h"

#include <string>
#include <vector>

namespace spall
{
enum class Marker
{
  none,
  dot,
  ring
};

/// Points of a chart in the units of its axes; a NaN interrupts the line.
struct Curve
{
  std::string name; ///< in the legend; empty: not there
  std::vector<double> x, y;
  std::string colour = "#0072B2";
  std::string dash = "";   ///< SVG stroke-dasharray; empty: solid
  double line_width = 1.6; ///< 0: no line [px]
  Marker marker = Marker::none;
  double marker_size = 2.7; ///< radius [px]
  double shift = 0.; ///< of x as drawn, so that curves do not hide each other
  std::string csv_name = ""; ///< in the CSV, where the legend has no name
  bool is_in_csv = true;     ///< false: its numbers are those of other curves

  double drawn_x(std::size_t k) const { return x[k] + shift; }
};

/// One figure: axes, curves, a legend above if there is more than one name.
struct Chart
{
  std::string id;        ///< file name without ending
  ReportSection section; ///< of the report of a run
  std::string caption;   ///< full sentences: what is plotted against what
  std::string x_label = "", y_label = "";
  std::vector<std::string> x_names = {};     ///< of x = 1, 2, ..., if any
  bool has_log_x = false, has_log_y = false; ///< values above 0 alone are drawn
  std::vector<Curve> curves = {};
  std::vector<std::string> notes = {}; ///< why something is not drawn
};

/// Range of one axis; its ticks are the multiples of the step inside. A
/// logarithmic one is an axis of decades.
struct Axis
{
  double low = 0., high = 1., step = 0.2;
  bool is_log = false;
};

/// An axis with about n steps of 1, 2 or 5 times a power of ten that covers the
/// range. It ends with a tick, and takes in zero, where that costs little.
Axis nice_axis(double low, double high, int n);

/// The whole decades that cover the range; of one at least.
Axis decade_axis(double low, double high);

/// Colour-blind safe (Okabe and Ito), distinguished by the dashes in print.
std::string palette_colour(std::size_t k);
inline constexpr std::size_t palette_size = 8; ///< then they come again
std::string palette_dash(std::size_t k);

/// An <svg> element for use inside a page; real text, no references.
std::string draw(const Chart &chart);

/// A horizontal bar of the shares of a whole, one row per name.
struct ShareBar
{
  std::vector<std::string> rows;
  std::vector<std::string> parts;
  std::vector<std::vector<double>> values; ///< [row][part], any unit
};
std::string draw(const ShareBar &bar);

/// The same element as a file of its own.
std::string svg_file(const std::string &element);
} // namespace spall
