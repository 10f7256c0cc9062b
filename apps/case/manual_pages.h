#pragma once

#include "case/fields.h"

#include <string>
#include <vector>

namespace spall
{
/// Where the manual treats a section of a case.
struct ManualPages
{
  std::string section;
  /// Page of docs/parameters that lists its keys (without ending). Empty: that
  /// of the kind of the section.
  std::string page = {};
  /// Pages of docs/ that explain it, such as "theory/contact.md".
  std::vector<std::string> explained_in = {};
};

/// Of a section of a case: the line of the table in manual_pages.cc, or the
/// page of its kind without links.
ManualPages manual_pages(const ListedSection &section);
} // namespace spall
