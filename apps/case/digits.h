#pragma once

#include <Eigen/Core>

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

inline std::string in_four_digits(const Eigen::Vector3d &position)
{
  return "(" + in_four_digits(position.x()) + ", " +
         in_four_digits(position.y()) + ", " + in_four_digits(position.z()) +
         ")";
}
} // namespace spall
