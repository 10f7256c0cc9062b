#include "triaxial/wave.h"

#include "case/parameter.h"
#include "case/source.h"
#include "errors.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <stdexcept>

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

/// A pair of numbers at `location`; throws InputError.
std::pair<double, double> read_pair(const std::string &text,
                                    const std::string &location)
{
  try
  {
    const std::size_t comma = text.find(',');
    if (comma == std::string::npos)
      throw std::invalid_argument("no comma");
    return {to_number(text.substr(0, comma)),
            to_number(text.substr(comma + 1))};
  }
  catch (const std::invalid_argument &)
  {
    throw InputError(location + ": \"" + text +
                     "\": a row is two numbers with decimal points, "
                     "share_1,value_1");
  }
}

void add_point(WaveTable &table, const std::string &text,
               const std::string &location)
{
  const auto [share, value] = read_pair(text, location);
  const std::string row = location + ": \"" + text + "\": ";
  if (table.share.empty() ? share != 0. : share <= table.share.back())
    throw InputError(row + "shares must ascend from 0 to 1");
  if (share > 1.)
    throw InputError(row + "a share must be at most 1");
  if (std::abs(value) > 1.)
    throw InputError(row + "a value must be between -1 and 1: the stage gives "
                           "the amplitude");
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
  std::ifstream in(path);
  if (!in || std::filesystem::is_directory(path))
    throw InputError(path + ": cannot be read as a wave");
  skip_byte_order_mark(in);
  WaveTable table;
  bool has_header = false;
  int n_lines = 0;
  for (std::string line; std::getline(in, line);)
  {
    const std::string location = path + ":" + std::to_string(++n_lines);
    std::erase_if(line,
                  [](char c) { return c == ' ' || c == '\t' || c == '\r'; });
    if (line.empty() || line.starts_with('#'))
      continue;
    if (has_header)
      add_point(table, line, location);
    else if (line == "share_1,value_1")
      has_header = true;
    else
      throw InputError(location + ": \"" + line +
                       "\": the header must be share_1,value_1");
  }
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
