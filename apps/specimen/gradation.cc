#include "specimen/gradation.h"

#include "case/parameter.h"
#include "errors.h"
#include "specimen/csv_table.h"

#include <algorithm>

namespace spall
{
namespace
{
/// Above it a diameter is refused, as that of Particle/diameter [m].
constexpr double largest_allowed = 10.;
constexpr const char *about_units =
    "diameters are in m, so those of a table in mm must be divided by 1000";

void add_row(Gradation &curve, const CsvRow &row)
{
  const double diameter = row.numbers[0], passing = row.numbers[1];
  if (diameter <= 0.)
    row.refuse("the diameter must be above 0");
  if (diameter > largest_allowed)
    row.refuse("the diameter must be at most " + number_text(largest_allowed) +
               " m; " + about_units);
  if (passing < 0. || passing > 1.)
    row.refuse("passing must be between 0 and 1 (a share, not per cent)");
  if (!curve.diameter.empty() && diameter <= curve.diameter.back())
    row.refuse("the diameters must increase; a single size is two rows close "
               "together, 0.02,0 and 0.0201,1");
  if (!curve.passing.empty() && passing < curve.passing.back())
    row.refuse("passing must not decrease");
  curve.diameter.push_back(diameter);
  curve.passing.push_back(passing);
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
  const std::string header = "diameter_m,passing_1";
  CsvTable table;
  try
  {
    table = read_number_table(path, header);
  }
  catch (const InputError &error)
  {
    const std::string what = error.what();
    const bool is_in_mm = what.find("diameter_mm") != std::string::npos;
    throw InputError(what + (is_in_mm ? std::string("; ") + about_units : ""));
  }
  Gradation curve;
  for (const CsvRow &row : table.rows)
    add_row(curve, row);
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
