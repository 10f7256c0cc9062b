#pragma once

#include <string>
#include <vector>

namespace spall
{
/// Grading curve: share of the mass finer than each diameter, linear in the
/// logarithm of the diameter in between.
struct Gradation
{
  std::vector<double> diameter; ///< strictly increasing [m]
  std::vector<double> passing;  ///< from 0 to 1, not decreasing [-]
};

/// Reads a CSV with the header diameter_m,passing_1; lines that start with #
/// are comments. Throws InputError: file, line, what is allowed.
Gradation read_gradation(const std::string &path);
} // namespace spall
