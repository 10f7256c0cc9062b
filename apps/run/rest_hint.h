#pragma once

#include "case/parameter.h"

#include <string>

namespace spall
{
/// Parameters to check where a poured layer does not come to rest, with
/// the values of the keys of this section. Damping near 1 slows the fall, too.
inline std::string rest_hint(const std::string &section, double max_time,
                             double unbalanced_ratio, double local_damping)
{
  constexpr double slows_the_fall = 0.9; // [-]
  const auto key = [&section](const char *name, double value)
  { return section + "/" + name + " = " + number_text(value); };
  if (local_damping > slows_the_fall)
    return ": " + key("local_damping", local_damping) +
           " takes that share of the weight of what falls, so it falls too "
           "slowly: must be lower";
  return ": see " + key("max_time", max_time) + " s, " +
         key("unbalanced_ratio", unbalanced_ratio) + ", " +
         key("local_damping", local_damping);
}
} // namespace spall
