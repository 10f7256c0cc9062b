#pragma once

#include "case/case.h"
#include "case/parameter.h"

namespace spall
{
struct Section
{
  std::string name, sentence;
  std::vector<CaseKind> kinds = {};        ///< that have it; empty: all
  std::vector<std::string> old_names = {}; ///< deprecated, still read

  bool is_of(CaseKind kind) const { return is_among(kinds, kind); }
};

/// The sections of a case in the order of printing.
const std::vector<Section> &sections();

/// Every field of the case, listed once: reader, printers, template and
/// docs/parameters all use this list. The case must outlive it. A new field is
/// one line in case_fields.cc.
std::vector<Parameter> parameters_of(Case &of);

/// Sections that a material file (Material/file) may hold.
bool is_material_section(const std::string &section);
} // namespace spall
