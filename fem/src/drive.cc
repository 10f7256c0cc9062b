#include <fem/drive.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <utility>

namespace fem
{
Drive::Drive(Kind which, const Wave &what) : kind(which), wave(what)
{
  if (!std::isfinite(wave.amplitude) || !std::isfinite(wave.offset) ||
      !std::isfinite(wave.start) || !std::isfinite(wave.frequency) ||
      !(wave.frequency > 0.))
    throw std::invalid_argument(
        "drive: frequency = " + std::to_string(wave.frequency) +
        " 1/s, must be positive, and all of the wave finite");
}

Drive Drive::constant(double value)
{
  return {Kind::constant, {0., 1., value, 0.}};
}

Drive Drive::sine(const Wave &wave)
{
  return {Kind::sine, wave};
}

Drive Drive::haversine(const Wave &wave)
{
  return {Kind::haversine, wave};
}

Drive Drive::eccentric_mass(const Wave &wave)
{
  const double omega = 2. * std::numbers::pi * wave.frequency;
  Wave force = wave;
  force.amplitude *= omega * omega;
  return {Kind::sine, force};
}

Drive Drive::table(std::vector<double> times, std::vector<double> values)
{
  if (times.empty() || times.size() != values.size())
    throw std::invalid_argument("drive table: " + std::to_string(times.size()) +
                                " times for " + std::to_string(values.size()) +
                                " values, must be the same number above 0");
  for (std::size_t k = 0; k < times.size(); ++k)
    if (!std::isfinite(times[k]) || !std::isfinite(values[k]) ||
        (k > 0 && !(times[k] > times[k - 1])))
      throw std::invalid_argument("drive table: row " + std::to_string(k + 1) +
                                  ": times must ascend, all be finite");
  Drive drive(Kind::table, {});
  drive.times = std::move(times);
  drive.values = std::move(values);
  return drive;
}

double Drive::integral() const
{
  double sum = 0.;
  for (std::size_t k = 1; k < times.size(); ++k)
    sum += 0.5 * (values[k] + values[k - 1]) * (times[k] - times[k - 1]);
  return sum;
}

double Drive::operator()(double time) const
{
  const double phase =
      2. * std::numbers::pi * wave.frequency * std::max(0., time - wave.start);
  switch (kind)
  {
  case Kind::constant:
    return wave.offset;
  case Kind::sine:
    return wave.offset + wave.amplitude * std::sin(phase);
  case Kind::haversine:
    return wave.offset + wave.amplitude * 0.5 * (1. - std::cos(phase));
  case Kind::table:
    break;
  }
  const auto after = std::upper_bound(times.begin(), times.end(), time);
  if (after == times.begin())
    return values.front();
  if (after == times.end())
    return values.back();
  const auto k = static_cast<std::size_t>(after - times.begin());
  const double share = (time - times[k - 1]) / (times[k] - times[k - 1]);
  return values[k - 1] + share * (values[k] - values[k - 1]);
}
} // namespace fem
