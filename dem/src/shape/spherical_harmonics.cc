#include "zonal_table.h"

#include <dem/assert.h>
#include <dem/shape/spherical_harmonics.h>

#include <cmath>

namespace dem
{
namespace
{
using detail::Row;

/// Real and imaginary part of (x + i y)^m.
struct Powers
{
  Row real = {};
  Row imaginary = {};
};

Powers powers(const Vec3 &s, int order)
{
  Powers power;
  power.real[0] = 1.;
  for (int m = 1; m <= order; ++m)
  {
    const double c = power.real[m - 1], d = power.imaginary[m - 1];
    power.real[m] = s.x() * c - s.y() * d;
    power.imaginary[m] = s.x() * d + s.y() * c;
  }
  return power;
}

/// Re sum_m f(m) (c_m - i d_m) (x + i y)^(m - down) and the imaginary part of
/// the same with the sign that the derivative by y has.
struct PlanarSums
{
  double real = 0., imaginary = 0.;
};

template <int down>
PlanarSums planar_sums(const detail::RingSeries &series, const Powers &power,
                       int order)
{
  PlanarSums sum;
  for (int m = down; m <= order; ++m)
  {
    const double factor = down == 0 ? 1. : down == 1 ? m : m * (m - 1.);
    const double c = factor * series.cosine[m], d = factor * series.sine[m];
    const double p = power.real[m - down], q = power.imaginary[m - down];
    sum.real += c * p + d * q;
    sum.imaginary += d * p - c * q;
  }
  return sum;
}
} // namespace

int order_of(std::size_t n_coefficients)
{
  const int side = int(std::lround(std::sqrt(double(n_coefficients))));
  const bool is_square =
      std::size_t(side) * std::size_t(side) == n_coefficients;
  return is_square && side >= 1 && side <= max_order + 1 ? side - 1 : -1;
}

void evaluate_harmonics(int order, const Vec3 &s, std::span<double> values)
{
  DEM_ASSERT(order >= 0 && order <= max_order);
  DEM_ASSERT(values.size() == std::size_t(n_coefficients(order)));
  const detail::ZonalTable &table = detail::zonal_table();
  const Powers power = powers(s, order);
  Row rows[3] = {};
  for (int n = 0; n <= order; ++n)
  {
    double *row = rows[n % 3];
    detail::next_row(table, n, s.z(), rows[(n + 2) % 3], rows[(n + 1) % 3],
                     row);
    double *value = values.data() + harmonic_index(n, 0);
    for (int m = n; m >= 0; --m) // m = 0 last: its sine would be zero
    {
      value[-m] = row[m] * power.imaginary[m];
      value[m] = row[m] * power.real[m];
    }
  }
}

double radius(std::span<const double> coefficients, const Vec3 &s)
{
  const int order = order_of(coefficients.size());
  return planar_sums<0>(detail::ring_series(coefficients, s.z()),
                        powers(s, order), order)
      .real;
}

// The sum of q_nm(z) (x + i y)^m is a polynomial F of x, y, z that equals r on
// the sphere. For any such extension grad_S r = P_t grad F and
// H = P_t (grad grad F - (s . grad F) I) P_t.
RadialExpansion expand(std::span<const double> coefficients, const Vec3 &s)
{
  const int order = order_of(coefficients.size());
  const detail::RingDerivatives ring =
      detail::ring_derivatives(coefficients, s.z());
  const Powers power = powers(s, order);
  const PlanarSums in_plane = planar_sums<1>(ring.value, power, order);
  const PlanarSums twice = planar_sums<2>(ring.value, power, order);
  const PlanarSums mixed = planar_sums<1>(ring.first, power, order);
  const double along = planar_sums<0>(ring.second, power, order).real;

  const Vec3 slope(in_plane.real, in_plane.imaginary,
                   planar_sums<0>(ring.first, power, order).real);
  Mat3 bend;
  bend << twice.real, twice.imaginary, mixed.real,   //
      twice.imaginary, -twice.real, mixed.imaginary, //
      mixed.real, mixed.imaginary, along;
  const double outward = s.dot(slope);
  const Mat3 tangent = Mat3::Identity() - s * s.transpose();

  RadialExpansion expansion;
  expansion.direction = s;
  expansion.radius = planar_sums<0>(ring.value, power, order).real;
  expansion.gradient = slope - outward * s;
  expansion.hessian = tangent * bend * tangent - outward * tangent;
  return expansion;
}
} // namespace dem
