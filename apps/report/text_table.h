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

/// The words of a text in lines of at most 120 characters.
std::string in_lines(const std::string &text);

/// Head and rows with commas, cells in quotes where they need them.
std::string comma_separated(const TextTable &table);

/// Heading of level two, note in lines of at most 120 characters, and table.
std::string markdown(const TextTable &table);

/// A page up to its line `marker`, this line included. Throws InputError with
/// the name of the command if it is not there.
std::string page_before(const std::string &command, const std::string &path,
                        const std::string &marker);

/// Writes the page again with this text behind the line. Throws the same.
void renew_page(const std::string &command, const std::string &path,
                const std::string &marker, const std::string &text);
} // namespace spall
