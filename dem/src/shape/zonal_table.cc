#include "zonal_table.h"

#include <dem/assert.h>

#include <cmath>
#include <numbers>

namespace dem::detail
{
namespace
{
void fill_degree(ZonalTable &table, int n)
{
  for (int m = 0; m < n; ++m)
  {
    const double span = double(n - m) * (n + m);
    const double span_before = double(n - 1 - m) * (n - 1 + m);
    table.rise[n][m] = std::sqrt((2. * n - 1.) * (2. * n + 1.) / span);
    // the recurrence of m = n - 1 has one term only
    table.fall[n][m] =
        m == n - 1
            ? 0.
            : std::sqrt((2. * n + 1.) * span_before / ((2. * n - 3.) * span));
  }
  // m = 0 has no factor sqrt(2), hence the half
  for (int m = 0; m <= n; ++m)
    table.slope[n][m] =
        std::sqrt((m == 0 ? 0.5 : 1.) * double(n - m) * (n + m + 1));
  for (int m = 0; m < n; ++m)
    table.slope2[n][m] = table.slope[n][m] * table.slope[n][m + 1];
}

ZonalTable make_table()
{
  ZonalTable table;
  table.diagonal[0] = 0.5 / std::sqrt(std::numbers::pi);
  for (int m = 1; m <= max_order; ++m)
    table.diagonal[m] =
        table.diagonal[m - 1] *
        std::sqrt((2. * m + 1.) / (2. * m) * (m == 1 ? 2. : 1.));
  for (int n = 0; n <= max_order; ++n)
    fill_degree(table, n);
  return table;
}

void add_value(int n, const double *__restrict a, const double *__restrict q,
               RingSeries &sum)
{
  for (int m = 0; m <= n; ++m)
  {
    sum.cosine[m] += a[m] * q[m];
    sum.sine[m] += a[-m] * q[m];
  }
}
} // namespace

const ZonalTable &zonal_table()
{
  static const ZonalTable table = make_table();
  return table;
}

RingSeries ring_series(std::span<const double> coefficients, double z)
{
  const int order = order_of(coefficients.size());
  DEM_ASSERT(order >= 0);
  const ZonalTable &table = zonal_table();
  Row rows[3] = {};
  RingSeries sum;
  for (int n = 0; n <= order; ++n)
  {
    double *row = rows[n % 3];
    next_row(table, n, z, rows[(n + 2) % 3], rows[(n + 1) % 3], row);
    add_value(n, coefficients.data() + harmonic_index(n, 0), row, sum);
  }
  return sum;
}

RingDerivatives ring_derivatives(std::span<const double> coefficients, double z)
{
  const int order = order_of(coefficients.size());
  DEM_ASSERT(order >= 0);
  const ZonalTable &table = zonal_table();
  Row rows[3] = {}, first = {}, second = {};
  RingDerivatives sum;
  for (int n = 0; n <= order; ++n)
  {
    double *row = rows[n % 3];
    next_row(table, n, z, rows[(n + 2) % 3], rows[(n + 1) % 3], row);
    for (int m = 0; m <= n; ++m)
    {
      first[m] = table.slope[n][m] * row[m + 1];
      second[m] = table.slope2[n][m] * row[m + 2];
    }
    const double *a = coefficients.data() + harmonic_index(n, 0);
    add_value(n, a, row, sum.value);
    add_value(n, a, first, sum.first);
    add_value(n, a, second, sum.second);
  }
  return sum;
}
} // namespace dem::detail
