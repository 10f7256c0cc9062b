#pragma once

#include <dem/shape/fit.h>

#include <cmath>

/// Semi-axes and exponent of |x/a|^p + |y/b|^p + |z/c|^p = 1: an ellipsoid at
/// p = 2, nearer to its box above.
struct Superellipsoid
{
  dem::Vec3 semi_axes = dem::Vec3::Ones(); ///< [m]
  double exponent = 2.;                    ///< p > 1 [-]

  /// Distance from the centre to the surface along a unit vector [m].
  double radius(const dem::Vec3 &direction) const
  {
    return std::pow(direction.cwiseQuotient(semi_axes)
                        .cwiseAbs()
                        .array()
                        .pow(exponent)
                        .sum(),
                    -1. / exponent);
  }
};

/// A family of shapes from outside of the library: its series is all that the
/// library needs [m].
inline std::vector<double> coefficients_of(const Superellipsoid &shape,
                                           int order)
{
  return dem::fit_radius([&shape](const dem::Vec3 &direction)
                         { return shape.radius(direction); },
                         order);
}
