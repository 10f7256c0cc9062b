#include "table.h"

#include "report/text_table.h"

#include <algorithm>
#include <cstdio>
#include <iomanip>
#include <limits>
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

namespace
{
/// As plain text in a cell of Markdown.
std::string in_cell(const std::string &text)
{
  std::string out;
  for (const char c : text)
    out += c == '|' || c == '*' ? std::string("\\") + c : std::string(1, c);
  return out;
}

/// The row of a case whose error is nearest to its tolerance, or beyond it.
const Result *worst_row(std::span<const Result> results,
                        const std::string &family, const std::string &name)
{
  const auto share = [](const Row &row)
  {
    const double error = error_of(row);
    return error <= row.tolerance
               ? (row.tolerance > 0. ? error / row.tolerance : 0.)
               : std::numeric_limits<double>::infinity();
  };
  const Result *worst = nullptr;
  for (const Result &result : results)
    if (result.family == family && result.name == name &&
        (!worst || share(result.row) > share(worst->row)))
      worst = &result;
  return worst;
}
} // namespace

void write_markdown(std::span<const Family> families,
                    std::span<const Result> results, std::ostream &out)
{
  for (const Family &family : families)
  {
    out << "### " << family.name << "\n\n"
        << in_lines(family.subject) << "\n\n"
        << "| case | reference | numbers | error | tolerance |\n"
        << "|---|---|---|---|---|\n";
    for (const Case &one : family.cases)
    {
      const auto n = std::ranges::count_if(
          results, [&](const Result &result)
          { return result.family == family.name && result.name == one.name; });
      const Result *worst = worst_row(results, family.name, one.name);
      if (!worst)
        continue;
      out << "| " << one.name << " | " << in_cell(one.source) << " | " << n
          << " | " << number(error_of(worst->row), 2) << " | "
          << number(worst->row.tolerance, 2)
          << (is_held(worst->row) ? " |\n" : " **fails** |\n");
    }
    out << "\nTest: `verification_" << family.name << "`.\n\n";
  }
}
} // namespace spall::verify
