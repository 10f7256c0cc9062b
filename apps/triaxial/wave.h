#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace spall
{
/// Shapes of load waves over one pulse, in units of the amplitude.
enum class WaveForm : std::int32_t
{
  none,
  haversine,  ///< (1 - cos 2 pi x) / 2, mean 1/2
  sine,       ///< sin 2 pi x, mean 0
  square,     ///< 1 in the first half, flanks of a twentieth, mean 1/2
  triangular, ///< up to 1 and down again, mean 1/2
  pulse,      ///< two axles of a bogie and rest, mean 0.3
  table       ///< straight lines between given points
};

/// The names of the forms in files, in the order of the enumeration without
/// `none`.
const std::vector<std::string> &wave_names();

/// Value of a form other than `table` at a share x of the pulse, 0 at both ends
/// [-].
double wave_value(WaveForm form, double x);

/// Points of a wave: shares of the pulse that ascend from 0 to 1, and values,
/// the first and the last 0 [-].
struct WaveTable
{
  std::vector<double> share, value;

  double operator()(double x) const;
};

/// Reads a CSV file share_1,value_1. Throws InputError.
WaveTable read_wave_table(const std::string &path);

/// A load cycle: a pulse of length 1 / frequency, then rest.
struct Wave
{
  WaveForm form = WaveForm::none;
  double frequency = 1.; ///< of the pulse [Hz]
  double rest = 0.;      ///< after each pulse [s]
  WaveTable table = {};

  double period() const { return 1. / frequency + rest; } ///< [s]
  /// Value at a phase of the cycle in [0, 1], in units of the amplitude [-].
  double value(double phase) const;
  /// Phase of the largest value, the first one [-].
  double peak() const;
};
} // namespace spall
