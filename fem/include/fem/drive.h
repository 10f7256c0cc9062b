#pragma once

#include <string>
#include <vector>

namespace fem
{
/// A force [N], a displacement [m] or an angle over time: offset + amplitude
/// times a wave that starts at `start` (the offset alone before it), or a
/// table.
class Drive
{
public:
  struct Wave
  {
    double amplitude = 0.; ///< [N] or [m]
    double frequency = 1.; ///< [1/s]
    double offset = 0.;    ///< [N] or [m]
    double start = 0.;     ///< [s]
  };

  /// Always this: a dead weight is constant(-m g) along z.
  static Drive constant(double value);
  /// amplitude sin(2 pi f t)
  static Drive sine(const Wave &wave);
  /// amplitude (1 - cos(2 pi f t)) / 2: from zero to the amplitude and back.
  static Drive haversine(const Wave &wave);
  /// A mass m at distance e from an axis that turns at f: force m e omega^2
  /// sin(omega t) along one direction; wave.amplitude is m e [kg m].
  static Drive eccentric_mass(const Wave &wave);
  /// Straight lines between the rows; the ends hold beyond them. Throws
  /// std::invalid_argument unless times ascend and there is a row.
  static Drive table(std::vector<double> times, std::vector<double> values);

  /// Every one of these throws std::invalid_argument on a wave that is not
  /// finite or has no positive frequency.
  double operator()(double time) const;

  /// Of a table: time of its last row [s], and its integral from the first row
  /// to the last [unit s]. Zero for waves.
  double last_time() const { return times.empty() ? 0. : times.back(); }
  double integral() const;

private:
  enum class Kind
  {
    constant,
    sine,
    haversine,
    table
  };
  Drive(Kind which, const Wave &what);

  Kind kind = Kind::constant;
  Wave wave;
  std::vector<double> times, values;
};
} // namespace fem
