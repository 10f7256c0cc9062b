#pragma once

#include <string>
#include <vector>

namespace spall
{
struct ParameterPage
{
  std::string file; ///< in docs/parameters
  std::string text; ///< Markdown
};

/// The pages of docs/parameters: the index, and one for each group of sections
/// with a table for each section.
std::vector<ParameterPage> parameter_pages();
} // namespace spall
