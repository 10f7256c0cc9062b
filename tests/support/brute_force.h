#pragma once

#include <dem/shape/radius_map.h>

#include <algorithm>
#include <cmath>
#include <ctime>

/// What the tools share that hold the search for contact points of true
/// surfaces against a brute force.
namespace support
{
/// A particle of ball radius 1 with its map.
struct MappedBody
{
  dem::ParticleShape body;
  dem::RadiusMap map;

  explicit MappedBody(const dem::Coefficients &series)
      : body(dem::make_shape(std::make_shared<const dem::Coefficients>(series),
                             1.)),
        map(body.series)
  {
  }
};

/// How often search and brute force agree, and what the search costs.
struct Tally
{
  int n = 0, n_several = 0;
  int n_missed = 0;  ///< the brute force has found a deeper contact point
  int n_beaten = 0;  ///< the search has
  double worst = 0.; ///< error of the overlap where they agree
  double seconds = 0.;

  /// Overlaps over the diameter of the particle; whether both agree.
  bool add(double exact, double found)
  {
    ++n;
    const double error = std::abs(exact - found);
    const bool is_same = error <= 1e-6;
    if (is_same)
      worst = std::max(worst, error);
    else
      ++(found < exact ? n_missed : n_beaten);
    return is_same;
  }
};

inline double processor_time() ///< of this program [s]
{
  return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}
} // namespace support
