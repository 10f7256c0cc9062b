#pragma once

#include <string>

namespace spall
{
/// What the name of a column or of an outcome says: permanent_axial_strain_1
/// are the words "permanent axial strain" and the unit "–".
struct QuantityName
{
  std::string words;
  std::string unit; ///< as it is written; "–" without dimension, empty: unknown
};

QuantityName quantity_name(const std::string &name);

/// Of an axis: "Permanent axial strain (–)".
std::string axis_label(const std::string &name);

/// The unit of a key of a case, "-" if it has none, in brackets after its name.
std::string key_label(const std::string &key, const std::string &unit);
} // namespace spall
