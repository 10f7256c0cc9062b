#include "table.h"

#include <algorithm>
#include <cstdio>
#include <iomanip>
#include <ostream>

namespace spall::verify
{
namespace
{
std::string number(double value, int digits)
{
  char text[32];
  std::snprintf(text, sizeof text, "%.*g", digits, value);
  return text;
}

std::string quoted(const std::string &text)
{
  std::string result = "\"";
  for (const char c : text)
    result += c == '"' ? std::string("\"\"") : std::string(1, c);
  return result + "\"";
}

/// What a terminal and the page show of a row.
std::vector<std::string> cells(const Result &result)
{
  const Row &row = result.row;
  return {result.name,
          row.quantity,
          row.unit,
          number(row.reference, 7),
          number(row.computed, 7),
          number(error_of(row), 2),
          number(row.tolerance, 2)};
}

const std::vector<std::string> headings = {
    "case", "quantity", "unit", "reference", "computed", "error", "tolerance"};
} // namespace

std::vector<Result> run(const Family &family)
{
  std::vector<Result> results;
  for (const Case &one : family.cases)
    for (Row &row : one.run())
      results.push_back({family.name, one.name, one.source, std::move(row)});
  return results;
}

void print_table(std::span<const Result> results, std::ostream &out)
{
  std::vector<std::vector<std::string>> lines = {headings};
  for (const Result &result : results)
    lines.push_back(cells(result));
  std::vector<std::size_t> width(headings.size(), 0);
  for (const auto &line : lines)
    for (std::size_t c = 0; c < line.size(); ++c)
      width[c] = std::max(width[c], line[c].size());
  for (std::size_t k = 0; k < lines.size(); ++k)
  {
    for (std::size_t c = 0; c < width.size(); ++c)
      out << std::left << std::setw(static_cast<int>(width[c] + 2))
          << lines[k][c];
    out << (k > 0 && !is_held(results[k - 1].row) ? "FAILS\n" : "\n");
  }
}

void write_csv(std::span<const Result> results, std::ostream &out)
{
  out << "family,case,quantity,unit,reference,computed,error_1,tolerance_1,"
         "held,source\n";
  for (const Result &result : results)
  {
    const Row &row = result.row;
    out << result.family << ',' << result.name << ',' << quoted(row.quantity)
        << ',' << row.unit << ',' << number(row.reference, 17) << ','
        << number(row.computed, 17) << ',' << number(error_of(row), 6) << ','
        << number(row.tolerance, 6) << ',' << (is_held(row) ? 1 : 0) << ','
        << quoted(result.source) << '\n';
  }
}

void write_markdown(std::span<const Family> families,
                    std::span<const Result> results, std::ostream &out)
{
  for (const Family &family : families)
  {
    out << "## " << family.name << "\n\n" << family.subject << "\n\n";
    for (const std::string &heading : headings)
      out << "| " << heading << ' ';
    out << "|\n"
        << "|---|---|---|---|---|---|---|\n";
    for (const Result &result : results)
    {
      if (result.family != family.name)
        continue;
      for (const std::string &cell : cells(result))
        out << "| " << cell << ' ';
      out << (is_held(result.row) ? "|\n" : "**fails** |\n");
    }
    out << "\nReferences:\n\n";
    for (const Case &one : family.cases)
      out << "* " << one.name << ": " << one.source << ".\n";
    out << '\n';
  }
}
} // namespace spall::verify
