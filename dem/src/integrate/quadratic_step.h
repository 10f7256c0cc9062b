#pragma once

#include <cmath>
#include <limits>

namespace dem
{
/// dt^2 spring + 2 dt dashpot of one motion, both per mass.
struct Quadratic
{
  double spring = 0.;  ///< [1/s^2]
  double dashpot = 0.; ///< [1/s]

  double at(double dt) const
  {
    return dt > 0. ? dt * (dt * spring + 2. * dashpot) : 0.;
  }
  /// Where it reaches 4; infinite without spring and dashpot [s].
  double root() const
  {
    const double slope = dashpot + std::sqrt(dashpot * dashpot + 4. * spring);
    return slope > 0. ? 4. / slope : std::numeric_limits<double>::infinity();
  }
};
} // namespace dem
