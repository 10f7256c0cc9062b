#pragma once

#include <dem/shape/particle_shape.h>

#include <array>

namespace dem::detail
{
/// Degrees of b up to this one are form, those above roughness.
inline constexpr int low_degree = 4;

/// Sum of b_j^2 over the degrees above low_degree [-].
double high_energy(std::span<const double> coefficients);

/// How the values of a function are spread over the sphere, free of mean and
/// size: (value - mean) / deviation that a share i / 64 of the directions lies
/// below, from the least value to the largest [-].
using Quantiles = std::array<double, 65>;

/// A particle in its principal frame, x along the least moment of inertia, z
/// along the largest, as log(r / R) = log(r_e / R) + sum b_j Y_j: r_e is the
/// ellipsoid with the second moments of the particle, R the radius of the
/// sphere of its volume.
struct LogShape
{
  double volume_equivalent_radius = 0.; ///< R [m]
  double log_elongation = 0.;       ///< of the axes b / a of the ellipsoid [-]
  double log_flatness = 0.;         ///< c / b [-]
  std::vector<double> coefficients; ///< b_j up to the requested order [-]
  Quantiles quantiles = {};         ///< of sum b_j Y_j over the directions
};

LogShape log_shape(const Coefficients &shape, int order);

/// The series of such a particle up to the order of b. The values of sum b_j
/// Y_j are first moved, each by its rank, to these quantiles, with the energy
/// of the higher degrees kept. The particle is moved in its first degree until
/// its centroid is the origin, and scaled to its R. Empty if its radius comes
/// below a twentieth of R.
Coefficients from_log(const LogShape &log);

/// Bits 1, 2, 4: Y_nm changes its sign with x, y, z.
int parity_of(int n, int m);
} // namespace dem::detail
