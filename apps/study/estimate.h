#pragma once

#include <limits>
#include <span>
#include <string>

namespace spall
{
/// A mean with half the width of its 95 % interval (Student).
struct Estimate
{
  double mean = std::numeric_limits<double>::quiet_NaN(); ///< of no samples
  /// Infinite below two samples.
  double half_width = std::numeric_limits<double>::infinity();
  std::size_t n = 0;

  bool is_above(double value) const { return mean - half_width > value; }
  bool is_below(double value) const { return mean + half_width < value; }
  /// Whether the interval leaves out zero.
  bool is_resolved() const { return is_above(0.) || is_below(0.); }
};

/// Mean and half-width, and of a scale above 0 the share of the mean in it.
std::string in_words(const Estimate &estimate, double scale);

Estimate estimate_of(std::span<const double> samples);

/// Sample standard deviation; 0 below two samples.
double standard_deviation(std::span<const double> samples);

/// Two-sided 95 % point of Student's distribution [-].
double student_95(std::size_t degrees_of_freedom);
} // namespace spall
