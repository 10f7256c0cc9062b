#pragma once

#include <algorithm>
#include <string>
#include <vector>

namespace spall
{
enum class CaseKind
{
  dynamic_triaxial,
  single_particle,
  los_angeles,
  vibratory_compaction,
  subgrade
};

/// By the number of CaseKind.
inline const std::vector<std::string> kind_names = {
    "dynamic_triaxial", "single_particle", "los_angeles",
    "vibratory_compaction", "subgrade"};

/// Whether a list of kinds, of which an empty one means all, has this one.
inline bool is_among(const std::vector<CaseKind> &kinds, CaseKind kind)
{
  return kinds.empty() || std::ranges::find(kinds, kind) != kinds.end();
}
} // namespace spall
