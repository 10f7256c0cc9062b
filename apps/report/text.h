#pragma once

#include <string>

namespace spall
{
/// For text and attributes of HTML and SVG.
std::string escape(const std::string &text);

/// A number with n significant digits and a true minus sign, as 1.2·10⁻⁵ if it
/// is very small or large; an en dash for NaN and infinity.
std::string format(double value, int n_digits);

/// A number with n decimals and a true minus sign.
std::string format_fixed(double value, int n_decimals);

std::string base64(const std::string &bytes);
} // namespace spall
