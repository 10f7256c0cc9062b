#pragma once

#include "report/chart.h"

#include <cstddef>
#include <string>
#include <vector>

namespace spall
{
/// Width of the view box of a chart and height of its plot [px]; text of 12 px
/// is 9 pt at a width of 90 mm.
inline constexpr double chart_width = 480., plot_height = 250.;

/// An estimate from the number of characters [px].
double text_width_of(const std::string &text);

struct Tick
{
  double value;
  std::string text;
};

std::vector<Tick> ticks_of(const Axis &axis);

/// A row of a curve that its line goes through.
struct LinePoint
{
  std::size_t row;
  bool is_start; ///< of a piece of the line: nothing joins it to the last one
};

/// Where the data of a chart are in its view box.
class Frame
{
public:
  explicit Frame(const Chart &chart);

  double x(double value) const; ///< [px]; not finite where it has no position
  double y(double value) const; ///< [px], downward
  double floor() const { return top + plot_height; }

  /// The points of a line without those closer than a third of a pixel to the
  /// last.
  std::vector<LinePoint> line_points(const Curve &curve) const;

  /// Rows of a curve that have a position.
  std::vector<std::size_t> finite_rows(const Curve &curve) const;

  Axis x_axis, y_axis;
  std::vector<Tick> x_ticks;
  double left = 60., right = 16., top = 10.;
};
} // namespace spall
