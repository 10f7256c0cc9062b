#include "specimen/csv_table.h"

#include "case/parameter.h"
#include "case/source.h"
#include "errors.h"

#include <algorithm>
#include <filesystem>
#include <sstream>
#include <stdexcept>
#include <zlib.h>

namespace spall
{
namespace
{
/// The whole file, unpacked if it is compressed.
std::string file_text(const std::string &path)
{
  if (!std::filesystem::exists(path))
    throw InputError(path + ": no such file");
  if (std::filesystem::is_directory(path))
    throw InputError(path + ": is a folder, must be a CSV file");
  const gzFile file = gzopen(path.c_str(), "rb");
  if (file == nullptr)
    throw InputError(path + ": cannot be read");
  std::string text;
  std::vector<char> block(1 << 16);
  int n = 0;
  while ((n = gzread(file, block.data(),
                     static_cast<unsigned int>(block.size()))) > 0)
    text.append(block.data(), static_cast<std::size_t>(n));
  // A file that ends in the middle is reported by the last call.
  if (gzclose_r(file) != Z_OK || n < 0)
    throw InputError(path + ": cannot be unpacked, is it cut off?");
  return text;
}

/// The text without blanks before and after it.
std::string trimmed(const std::string &text)
{
  const auto first = text.find_first_not_of(" \t\r");
  if (first == std::string::npos)
    return "";
  return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

std::vector<std::string> cells_of(const std::string &text)
{
  std::vector<std::string> cells;
  std::size_t from = 0;
  for (std::size_t comma = 0; comma != std::string::npos; from = comma + 1)
  {
    comma = text.find(',', from);
    cells.push_back(trimmed(
        text.substr(from, comma == std::string::npos ? comma : comma - from)));
  }
  return cells;
}

} // namespace

void CsvRow::refuse(const std::string &allowed) const
{
  constexpr std::size_t longest = 80;
  const bool has_other_separators =
      text.find(',') == std::string::npos &&
      text.find_first_of(";\t") != std::string::npos;
  throw InputError(location + ": \"" + text.substr(0, longest) +
                   "\": " + allowed +
                   (has_other_separators ? "; commas separate cells" : ""));
}

int CsvTable::column(const std::string &name) const
{
  const auto found = std::ranges::find(header.cells, name);
  return found == header.cells.end()
             ? -1
             : static_cast<int>(found - header.cells.begin());
}

namespace
{
/// The header must be this one where it is exact.
CsvTable read(const std::string &path, const std::string &header, bool is_exact)
{
  std::istringstream in(file_text(path));
  skip_byte_order_mark(in); // of spreadsheets
  CsvTable table;
  int n_lines = 0;
  for (std::string line; std::getline(in, line);)
  {
    CsvRow row{trimmed(line), path + ":" + std::to_string(++n_lines), {}, {}};
    if (row.text.empty())
      continue;
    if (row.text.starts_with('#'))
    {
      table.comments.push_back(std::move(row));
      continue;
    }
    row.cells = cells_of(row.text);
    const std::size_t n = table.header.cells.size();
    if (n > 0 && row.cells.size() != n)
      row.refuse("has " + std::to_string(row.cells.size()) +
                 " cells, must have " + std::to_string(n) +
                 " as the header has: " + table.header.text);
    if (n == 0 && is_exact && row.cells != cells_of(header))
      row.refuse("the header must be " + header);
    if (n == 0)
      table.header = std::move(row);
    else
      table.rows.push_back(std::move(row));
  }
  if (table.header.cells.empty())
    throw InputError(path + ": is empty, the first line must be " + header);
  return table;
}

} // namespace

CsvTable read_csv(const std::string &path, const std::string &header)
{
  return read(path, header, false);
}

CsvTable read_number_table(const std::string &path, const std::string &header)
{
  CsvTable table = read(path, header, true);
  for (CsvRow &row : table.rows)
    try
    {
      for (const std::string &cell : row.cells)
        row.numbers.push_back(to_number(cell));
    }
    catch (const std::invalid_argument &)
    {
      row.refuse("a row is numbers with decimal points, " + header);
    }
  return table;
}

ColumnPair read_ascending(const std::string &path, const std::string &header)
{
  const CsvTable table = read_number_table(path, header);
  ColumnPair columns;
  for (const CsvRow &row : table.rows)
  {
    const double first = row.numbers[0];
    if (columns.first.empty() ? first != 0. : first <= columns.first.back())
      row.refuse("the first column of " + header + " must ascend from 0");
    columns.first.push_back(first);
    columns.second.push_back(row.numbers[1]);
  }
  if (columns.first.empty())
    throw InputError(path + ": must be the header " + header +
                     " and a row or more");
  return columns;
}
} // namespace spall
