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
/// are comments. Rows below the last 0 and above the first 1 are left out: no
/// particle has such a size. Throws InputError: file, line, what is allowed.
Gradation read_gradation(const std::string &path);

/// Whether a diameter given in m is probably one in mm.
bool looks_like_millimetres(double diameter);

/// The largest diameter for a message, "0.0224 m", with a note on units
/// where it looks like a number in mm.
std::string largest_text(const Gradation &gradation);
} // namespace spall
