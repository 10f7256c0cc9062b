#include "column_file.h"

#include <cmath>
#include <fstream>
#include <sstream>
#include <stdexcept>

namespace fem
{
namespace
{
std::string without_blanks(const std::string &text)
{
  std::string kept;
  for (const char c : text)
    if (c != ' ' && c != '\t' && c != '\r')
      kept += c;
  return kept;
}

/// Takes a row if it is one that may follow.
bool take_row(const std::string &line, ColumnPair &columns)
{
  std::istringstream row(line);
  double first = 0., second = 0.;
  char comma = ' ';
  const bool is_row = bool(row >> first >> comma >> second) && comma == ',' &&
                      (row >> std::ws).eof() && std::isfinite(first) &&
                      std::isfinite(second);
  if (!is_row ||
      !(columns.first.empty() ? first == 0. : first > columns.first.back()))
    return false;
  columns.first.push_back(first);
  columns.second.push_back(second);
  return true;
}
} // namespace

ColumnPair read_columns(const std::string &path, const std::string &header)
{
  std::ifstream file(path);
  if (!file)
    throw std::invalid_argument(path + ": cannot be read");
  ColumnPair columns;
  bool has_header = false;
  std::string line;
  for (int number = 1; std::getline(file, line); ++number)
  {
    if (number == 1 && line.starts_with("\xEF\xBB\xBF")) // of spreadsheets
      line.erase(0, 3);
    const std::string text = without_blanks(line);
    if (text.empty())
      continue;
    if (has_header ? !take_row(line, columns) : text != header)
      throw std::invalid_argument(
          path + ", line " + std::to_string(number) + ": \"" + line +
          "\": must be " +
          (has_header ? "two numbers " + header + ", the first ascending from 0"
                      : "the header " + header));
    has_header = true;
  }
  if (columns.first.empty())
    throw std::invalid_argument(path + ": must be the header " + header +
                                " and a row or more");
  return columns;
}
} // namespace fem
