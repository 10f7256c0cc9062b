#include "triaxial/wave.h"

#include "errors.h"
#include "specimen/csv_table.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace spall
{
namespace
{
/// Length of a flank of a square wave, a share of the pulse.
constexpr double flank = 0.05;

/// The two axles of a bogie: haversines of this length, the second one so much
/// later, both a share of the pulse. Between them the load falls to a half.
constexpr double axle_length = 0.3, axle_delay = 0.2;

double haversine(double x)
{
  return 0.5 * (1. - std::cos(2. * std::numbers::pi * x));
}

double haversine_within(double x)
{
  return x > 0. && x < 1. ? haversine(x) : 0.;
}

void add_point(WaveTable &table, const CsvRow &row)
{
  const double share = row.numbers[0], value = row.numbers[1];
  if (table.share.empty() ? share != 0. : share <= table.share.back())
    row.refuse("shares must ascend from 0 to 1");
  if (share > 1.)
    row.refuse("a share must be at most 1");
  if (std::abs(value) > 1.)
    row.refuse("a value must be between -1 and 1: the stage gives the "
               "amplitude");
  table.share.push_back(share);
  table.value.push_back(value);
}
} // namespace

const std::vector<std::string> &wave_names()
{
  static const std::vector<std::string> names = {
      "haversine", "sine", "square", "triangular", "pulse", "table"};
  return names;
}

double wave_value(WaveForm form, double x)
{
  switch (form)
  {
  case WaveForm::haversine:
    return haversine(x);
  case WaveForm::sine:
    return std::sin(2. * std::numbers::pi * x);
  case WaveForm::square:
    return std::clamp(std::min(x, 0.5 + flank - x) / flank, 0., 1.);
  case WaveForm::triangular:
    return 1. - std::abs(2. * x - 1.);
  case WaveForm::pulse:
    return haversine_within(x / axle_length) +
           haversine_within((x - axle_delay) / axle_length);
  case WaveForm::none:
  case WaveForm::table:
    break;
  }
  return 0.;
}

double WaveTable::operator()(double x) const
{
  const auto after = std::ranges::upper_bound(share, x);
  if (after == share.begin())
    return value.front();
  if (after == share.end())
    return value.back();
  const auto k = static_cast<std::size_t>(after - share.begin());
  return std::lerp(value[k - 1], value[k],
                   (x - share[k - 1]) / (share[k] - share[k - 1]));
}

WaveTable read_wave_table(const std::string &path)
{
  WaveTable table;
  for (const CsvRow &row : read_number_table(path, "share_1,value_1").rows)
    add_point(table, row);
  if (table.share.size() < 3 || table.share.back() != 1. ||
      table.value.front() != 0. || table.value.back() != 0.)
    throw InputError(path + ": a wave needs at least three rows, the first "
                            "0,0 and the last 1,0");
  return table;
}

double Wave::value(double phase) const
{
  const double x = phase * (1. + rest * frequency);
  if (x > 1.)
    return 0.;
  return form == WaveForm::table ? table(x) : wave_value(form, x);
}

double Wave::peak() const
{
  const double pulse = 1. / (1. + rest * frequency);
  switch (form)
  {
  case WaveForm::sine:
    return 0.25 * pulse;
  case WaveForm::square:
    return flank * pulse;
  case WaveForm::pulse:
    return 0.5 * axle_length * pulse;
  case WaveForm::table:
    return table.share[static_cast<std::size_t>(
               std::ranges::max_element(table.value) - table.value.begin())] *
           pulse;
  default:
    return 0.5 * pulse;
  }
}
} // namespace spall
