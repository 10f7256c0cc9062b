#include "specimen/json_table.h"

#include "errors.h"

#include <nlohmann/json.hpp>

#include <fstream>

namespace spall
{
namespace
{
using Json = nlohmann::ordered_json;

Json parsed(const std::string &path)
{
  std::ifstream in(path);
  if (!in)
    throw InputError(path + ": no such file");
  try
  {
    return Json::parse(in);
  }
  catch (const Json::parse_error &error)
  {
    throw InputError(path + ": is not JSON: at byte " +
                     std::to_string(error.byte));
  }
}

CsvRow empty_row(const std::string &path, std::size_t particle)
{
  CsvRow row;
  row.location = path + ": particle " + std::to_string(particle + 1);
  return row;
}

std::string cell_of(const Json &value, const CsvRow &row,
                    const std::string &key)
{
  if (value.is_string())
    return value.get<std::string>();
  if (!value.is_number())
    row.refuse(key + " must be a number or a text");
  return value.dump(); // all its digits
}

/// Columns in the order of the first particle.
CsvRow header_of(const Json &particles, const std::string &path)
{
  CsvRow header = empty_row(path, 0);
  for (const auto &[key, value] : particles[0].items())
  {
    header.cells.push_back(key);
    header.text += (header.text.empty() ? "" : ",") + key;
  }
  return header;
}

CsvRow row_of_particle(const Json &particle, const CsvRow &header, CsvRow empty)
{
  empty.text = particle.dump();
  if (!particle.is_object() || particle.size() != header.cells.size())
    empty.refuse("must have the keys " + header.text);
  for (const std::string &key : header.cells)
  {
    if (!particle.contains(key))
      empty.refuse("must have the keys " + header.text);
    empty.cells.push_back(cell_of(particle[key], empty, key));
  }
  return empty;
}

/// As the comment of a CSV file has it.
CsvRow box_of(const Json &box, const std::string &path)
{
  CsvRow row;
  row.location = path + ": box";
  row.text = "# box";
  if (box.is_array())
    for (const Json &side : box)
      row.text += " " + side.dump();
  return row;
}
} // namespace

CsvTable read_json_table(const std::string &path)
{
  const Json file = parsed(path);
  const bool has_box = file.is_object() && file.contains("box");
  const Json particles =
      file.is_object() && file.contains("particles") ? file["particles"] : file;
  if (!particles.is_array() || particles.empty() || !particles[0].is_object())
    throw InputError(path + ": must be an array of particles, each an object "
                            "with x, y, z and radius or diameter, or an object "
                            "with this array as particles");
  CsvTable table;
  table.header = header_of(particles, path);
  for (std::size_t k = 0; k < particles.size(); ++k)
    table.rows.push_back(
        row_of_particle(particles[k], table.header, empty_row(path, k)));
  if (has_box)
    table.comments.push_back(box_of(file["box"], path));
  return table;
}
} // namespace spall
