#include "specimen/gradation.h"

#include "case/parameter.h"
#include "case/source.h"
#include "errors.h"

#include <algorithm>
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

/// Above it a diameter is refused, as that of Particle/diameter [m].
constexpr double largest_allowed = 10.;
constexpr const char *about_units =
    "diameters are in m, so those of a table in mm must be divided by 1000";

void add_row(Gradation &curve, const std::string &text,
             const std::string &location)
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
    throw InputError(location + ": \"" + text +
                     "\": a row is two numbers with decimal points, "
                     "diameter_m,passing_1");
  }
  const std::string row = location + ": \"" + text + "\": ";
  if (diameter <= 0.)
    throw InputError(row + "the diameter must be above 0");
  if (diameter > largest_allowed)
    throw InputError(row + "the diameter must be at most " +
                     number_text(largest_allowed) + " m; " + about_units);
  if (passing < 0. || passing > 1.)
    throw InputError(row + "passing must be between 0 and 1 (a share, not "
                           "per cent)");
  if (!curve.diameter.empty() && diameter <= curve.diameter.back())
    throw InputError(row + "the diameters must increase; a single size is "
                           "two rows close together, 0.02,0 and 0.0201,1");
  if (!curve.passing.empty() && passing < curve.passing.back())
    throw InputError(row + "passing must not decrease");
  curve.diameter.push_back(diameter);
  curve.passing.push_back(passing);
}

[[noreturn]] void refuse_header(const std::string &location,
                                const std::string &text)
{
  const bool is_in_mm = text.find("mm") != std::string::npos;
  throw InputError(location + ": \"" + text +
                   "\": the header must be diameter_m,passing_1" +
                   (is_in_mm ? std::string("; ") + about_units : ""));
}

/// Leaves out the rows below the last 0 and above the first 1.
void trim(Gradation &curve)
{
  const auto first_filled =
      std::ranges::find_if(curve.passing, [](double p) { return p > 0.; });
  const auto first_whole = std::ranges::find(curve.passing, 1.);
  const auto begin = first_filled - curve.passing.begin() - 1,
             end = first_whole - curve.passing.begin() + 1;
  const auto cut = [&](std::vector<double> &values) {
    values = {values.begin() + begin, values.begin() + end};
  };
  cut(curve.diameter);
  cut(curve.passing);
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
    const std::string location = path + ":" + std::to_string(++n_lines);
    const std::string text = strip(line);
    if (text.empty() || text.starts_with('#'))
      continue;
    if (has_header)
      add_row(curve, text, location);
    else if (text == "diameter_m,passing_1")
      has_header = true;
    else
      refuse_header(location, text);
  }
  if (curve.diameter.size() < 2)
    throw InputError(path + ": a gradation needs at least two rows");
  if (curve.passing.front() != 0. || curve.passing.back() != 1.)
    throw InputError(path + ": passing must begin with 0 and end with 1");
  trim(curve);
  return curve;
}

bool looks_like_millimetres(double diameter)
{
  return diameter > 1.;
}

std::string largest_text(const Gradation &gradation)
{
  const double largest = gradation.diameter.back();
  return number_text(largest) + " m" +
         (looks_like_millimetres(largest)
              ? std::string(" (") + about_units + ")"
              : "");
}
} // namespace spall
