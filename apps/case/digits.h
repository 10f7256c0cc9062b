#pragma once

#include <sstream>
#include <string>

namespace spall
{
/// As a message has it.
inline std::string in_four_digits(double value)
{
  std::ostringstream text;
  text.precision(4);
  text << value;
  return text.str();
}
} // namespace spall
