#include "run/quantity_name.h"

#include <algorithm>
#include <cctype>
#include <utility>

namespace spall
{
namespace
{
/// How names end, the longer ones first.
constexpr std::pair<const char *, const char *> units[] = {
    {"_kg_per_m3", "kg/m³"},
    {"_m_per_s2", "m/s²"},
    {"_m_per_s", "m/s"},
    {"_percent", "%"},
    {"_rad", "rad"},
    {"_kg", "kg"},
    {"_Pa", "Pa"},
    {"_Hz", "Hz"},
    {"_Nm", "N m"},
    {"_Ns", "N s"},
    {"_m3", "m³"},
    {"_m2", "m²"},
    {"_m", "m"},
    {"_s", "s"},
    {"_N", "N"},
    {"_J", "J"},
    {"_B", "B"},
    {"_1", "–"}};

/// Counts are called by what is counted, and abbreviations in capitals.
std::string in_words(std::string name)
{
  if (name.starts_with("n_"))
    name.erase(0, 2);
  if (name == "laa")
    return "LAA";
  for (char &letter : name)
    if (letter == '_')
      letter = ' ';
  return name;
}

std::string with_unit(const std::string &words, const std::string &unit)
{
  return unit.empty() ? words : words + " (" + unit + ")";
}
} // namespace

QuantityName quantity_name(const std::string &name)
{
  for (const auto &[ending, unit] : units)
    if (name.ends_with(ending))
      return {
          in_words(name.substr(0, name.size() - std::string(ending).size())),
          unit};
  return {in_words(name), "–"}; // names without an ending have no dimension
}

std::string axis_label(const std::string &name)
{
  QuantityName quantity = quantity_name(name);
  char &first = quantity.words.front();
  first = static_cast<char>(std::toupper(static_cast<unsigned char>(first)));
  return with_unit(quantity.words, quantity.unit);
}

std::string key_label(const std::string &key, const std::string &unit)
{
  std::string words = key;
  std::ranges::replace(words, '/', ' ');
  return with_unit(in_words(words), unit == "-" ? "–" : unit);
}
} // namespace spall
