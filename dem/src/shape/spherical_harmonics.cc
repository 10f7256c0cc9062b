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
} // namespace

int order_of(std::size_t n_coefficients)
{
  const int side = int(std::sqrt(double(n_coefficients)) + 0.5);
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
} // namespace dem
