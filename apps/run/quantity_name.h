#pragma once

#include <string>

namespace spall
{
/// Quantity and unit from the name of a column or of an outcome:
/// permanent_axial_strain_1 are the words "permanent axial strain" and the unit
/// "–".
struct QuantityName
{
  std::string words;
  std::string unit; ///< as it is written; "–" without dimension
};

QuantityName quantity_name(const std::string &name);

/// Of an axis: "Permanent axial strain (–)".
std::string axis_label(const std::string &name);

/// The words of a key of a case, "Loading confining pressure (Pa)"; its unit is
/// "-" if it has none.
std::string key_label(const std::string &key, const std::string &unit);
} // namespace spall
