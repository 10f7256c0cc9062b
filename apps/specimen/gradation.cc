#include "specimen/gradation.h"

#include "case/parameter.h"
#include "case/source.h"
#include "errors.h"

#include <filesystem>
#include <fstream>
#include <stdexcept>

namespace spall
{
namespace
{
std::string strip(const std::string &text)
{
  std::string result;
  for (const char c : text)
    if (c != ' ' && c != '\t' && c != '\r')
      result += c;
  return result;
}

void add_row(Gradation &curve, const std::string &text,
             const std::string &place)
{
  const std::size_t comma = text.find(',');
  double diameter = 0., passing = 0.;
  try
  {
    if (comma == std::string::npos)
      throw std::invalid_argument("no comma");
    diameter = to_number(text.substr(0, comma));
    passing = to_number(text.substr(comma + 1));
  }
  catch (const std::invalid_argument &)
  {
    throw InputError(place + ": \"" + text +
                     "\": a row is two numbers, diameter_m,passing_1");
  }
  const std::string row = place + ": \"" + text + "\": ";
  if (diameter <= 0.)
    throw InputError(row + "the diameter must be above 0");
  if (passing < 0. || passing > 1.)
    throw InputError(row + "passing must be between 0 and 1");
  if (!curve.diameter.empty() && diameter <= curve.diameter.back())
    throw InputError(row + "the diameters must increase");
  if (!curve.passing.empty() && passing < curve.passing.back())
    throw InputError(row + "passing must not decrease");
  curve.diameter.push_back(diameter);
  curve.passing.push_back(passing);
}
} // namespace

Gradation read_gradation(const std::string &path)
{
  std::ifstream in(path);
  if (!in || std::filesystem::is_directory(path))
    throw InputError(path + ": cannot be read as a gradation");
  skip_byte_order_mark(in); // of spreadsheets
  Gradation curve;
  bool has_header = false;
  int n_lines = 0;
  for (std::string line; std::getline(in, line);)
  {
    const std::string place = path + ":" + std::to_string(++n_lines);
    const std::string text = strip(line);
    if (text.empty() || text.starts_with('#'))
      continue;
    if (has_header)
      add_row(curve, text, place);
    else if (text == "diameter_m,passing_1")
      has_header = true;
    else
      throw InputError(place + ": \"" + text +
                       "\": the header must be diameter_m,passing_1");
  }
  if (curve.diameter.size() < 2)
    throw InputError(path + ": a gradation needs at least two rows");
  if (curve.passing.front() != 0. || curve.passing.back() != 1.)
    throw InputError(path + ": passing must begin with 0 and end with 1");
  return curve;
}
} // namespace spall
