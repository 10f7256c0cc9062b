#pragma once

#include <dem/vector.h>

#include <numbers>
#include <span>

namespace dem
{
/// Highest order a series may have [-].
inline constexpr int max_order = 30;

/// Number of coefficients of a series of this order [-].
constexpr int n_coefficients(int order)
{
  return (order + 1) * (order + 1);
}

/// Mean radius over a_00: Y_00 = 1 / sqrt(4 pi) [-].
inline constexpr double equivalent_radius_factor =
    0.5 * std::numbers::inv_sqrtpi_v<double>;

/// Index of the harmonic of degree n and order m, -n <= m <= n, in a row of
/// coefficients [-].
constexpr int harmonic_index(int n, int m)
{
  return n * (n + 1) + m;
}

/// Order of a series with this many coefficients [-]; -1 if the number is no
/// square of 1 .. max_order + 1.
int order_of(std::size_t n_coefficients);

/// Value, surface gradient and covariant Hessian of r at one direction of the
/// unit sphere: r(s + w) = radius + gradient.w + w.hessian.w / 2 for a small
/// tangent displacement w.
struct RadialExpansion
{
  Vec3 direction = Vec3::UnitZ(); ///< s, unit, body frame [-]
  double radius = 0.;             ///< r(s) [m]
  Vec3 gradient = Vec3::Zero();   ///< grad_S r, tangent to s [m]
  Mat3 hessian = Mat3::Zero();    ///< covariant Hessian, P_t H P_t [m]
};

/// Y_j(s) of all degrees up to order [-]: real, orthonormal on the unit sphere,
/// no Condon-Shortley phase, j = n (n + 1) + m. `values` has
/// n_coefficients(order) entries, `s` is a unit vector.
void evaluate_harmonics(int order, const Vec3 &s, std::span<double> values);

/// r(s) = sum_j a_j Y_j(s) [m]. `s` is a unit vector in the body frame.
double radius(std::span<const double> coefficients, const Vec3 &s);

/// r and its first two derivatives on the sphere from a polynomial in x, y, z
/// that equals r on it, which has no trouble at the poles. Same digits for
/// every instruction set.
RadialExpansion expand(std::span<const double> coefficients, const Vec3 &s);

/// The same for many directions of one shape, a direction per SIMD lane:
/// several times faster from some ten directions on. Differs from the above by
/// round-off; does not depend on which directions stand beside each other.
void expand(std::span<const double> coefficients, std::span<const Vec3> s,
            std::span<RadialExpansion> expansions);
} // namespace dem
