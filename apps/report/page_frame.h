#pragma once

#include <string>
#include <vector>

namespace spall
{
struct PageHead
{
  std::string title, from;  ///< text
  std::string summary = ""; ///< HTML under the title
};

struct PageSection
{
  std::string id, title; ///< text
  std::string body;      ///< HTML; empty: the page does not have the section
};

/// A whole HTML page: the title, a list of contents that links to the sections,
/// and the sections. It needs no other file, no network and no script.
std::string framed_page(const PageHead &head,
                        const std::vector<PageSection> &sections);

/// Letters and digits of a title, joined by dashes: the id of its section.
std::string section_id(const std::string &title);
} // namespace spall
