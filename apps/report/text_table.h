#pragma once

#include <string>
#include <vector>

namespace spall
{
using Cells = std::vector<std::string>;

/// A table as text, with a heading and a sentence or two above it.
struct TextTable
{
  std::string title;
  std::string note;
  Cells head;
  std::vector<Cells> rows; ///< as long as the head, or shorter
};

/// A table element; title and note are the caller's.
std::string html_rows(const TextTable &table);

/// Heading of level two, note and table.
std::string markdown(const TextTable &table);

/// Writes the page again up to its line `marker`, which must be there, and the
/// text after it. Throws InputError with the name of the command.
void renew_page(const std::string &command, const std::string &path,
                const std::string &marker, const std::string &text);
} // namespace spall
