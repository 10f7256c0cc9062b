#include "reference_table.h"

#include "../errors.h"
#include "case/data_folders.h"
#include "case/parameter.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>

namespace spall::verify
{
namespace
{
namespace fs = std::filesystem;

std::string find_file(const std::string &file)
{
  for (const fs::path &folder : data_folders())
    if (fs::exists(folder / "reference" / file))
      return (folder / "reference" / file).string();
  throw InputError("verify: reference/" + file +
                   ": no such file in the data "
                   "of the program: see SPALL_DATA_DIR");
}

std::vector<std::string> split(const std::string &line)
{
  std::vector<std::string> cells;
  std::istringstream text(line);
  for (std::string cell; std::getline(text, cell, ',');)
    cells.push_back(cell);
  return cells;
}
} // namespace

ReferenceTable::ReferenceTable(const std::string &file) : path(find_file(file))
{
  std::ifstream in(path);
  std::string line;
  std::getline(in, line);
  headings = split(line);
  headings.erase(headings.begin());
  while (std::getline(in, line))
  {
    const std::vector<std::string> cells = split(line);
    if (cells.size() != headings.size() + 1)
      throw InputError(path + ": \"" + line + "\": needs " +
                       std::to_string(headings.size() + 1) + " columns");
    names.push_back(cells[0]);
    rows.emplace_back();
    try
    {
      for (std::size_t c = 1; c < cells.size(); ++c)
        rows.back().push_back(to_number(cells[c]));
    }
    catch (const std::invalid_argument &error)
    {
      throw InputError(path + ": \"" + line + "\": " + error.what());
    }
  }
}

double ReferenceTable::value(std::size_t row, const std::string &column) const
{
  const auto found = std::ranges::find(headings, column);
  if (found == headings.end())
    throw InputError(path + ": no column " + column);
  return rows[row][static_cast<std::size_t>(found - headings.begin())];
}
} // namespace spall::verify
