#pragma once

#include <dem/contact/laws/hertz.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

namespace dem
{
/// Overlap at which a Hertz spring has taken up the energy of an impact [m]:
/// m v^2 / 2 = 2/5 C_H delta^(5/2). `mass`: reduced [kg].
inline double impact_overlap(double normal_prefactor, double mass, double speed)
{
  return std::pow(0.5 * mass * speed * speed /
                      (hertz_energy_share * normal_prefactor),
                  1. / (Hertz::exponent + 1.));
}

/// Duration of an undamped Hertz impact [s]: 4 sqrt(pi) Gamma(2/5) /
/// (5 Gamma(9/10)) delta_max / v (Landau and Lifshitz, Theory of Elasticity,
/// section 9). Infinite at rest.
inline double impact_duration(double normal_prefactor, double mass,
                              double speed)
{
  constexpr double shape_of_pulse = 2.94327518432470;
  return speed > 0. ? shape_of_pulse *
                          impact_overlap(normal_prefactor, mass, speed) / speed
                    : std::numeric_limits<double>::infinity();
}

/// Non-conservative work of a Hertz impact of n steps is at most this number
/// over n^2 times its kinetic energy, for any instant of touch, n >= 4 and
/// shares of critical damping up to 0.8 (docs/theory/time_step.md) [-].
inline constexpr double impact_error_factor = 2.3;

/// Steps that an impact needs for this non-conservative work over its kinetic
/// energy [-].
inline double steps_of_impact(double tolerance)
{
  return std::max(4., std::sqrt(impact_error_factor / tolerance));
}

/// The shortest Hertz impact that is under way or foreseen.
struct ForeseenImpact
{
  double duration = std::numeric_limits<double>::infinity(); ///< [s]
  double speed = 0.;                                         ///< closing [m/s]
  std::int32_t body = -1;                                    ///< of the network

  /// Takes the shorter one, of equal ones the faster.
  void meet(const ForeseenImpact &other)
  {
    if (other.duration < duration ||
        (other.duration == duration && other.speed > speed))
      *this = other;
  }
};
} // namespace dem
