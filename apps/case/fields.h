#pragma once

#include "case/case.h"
#include "case/parameter.h"

#include <algorithm>

namespace spall
{
/// A section and the kinds that have it.
struct ListedSection : Section
{
  std::vector<std::string> kinds; ///< empty: all

  bool is_of(const std::string &kind) const
  {
    return kinds.empty() || std::ranges::find(kinds, kind) != kinds.end();
  }
};

/// The sections of a case in the order of printing: those of the kinds, the
/// common ones, and one for each of its walls.
std::vector<ListedSection> sections(const Case &of);

/// Every field of the case, listed once: reader, printers, template and
/// docs/parameters, checkpoints, preparations and studies all use this list.
/// The case must outlive it. A new field is one line in fields.cc of its
/// section.
std::vector<Parameter> parameters_of(Case &of);

/// Sections that a material file (Material/file) may hold.
bool is_material_section(const std::string &section);
} // namespace spall
