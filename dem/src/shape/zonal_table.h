#pragma once

#include <dem/shape/spherical_harmonics.h>

namespace dem::detail
{
/// Longest row of one degree, padded so that m + 2 may be read [-].
inline constexpr int row_length = max_order + 3;

/// One number per order m of one degree.
using Row = double[row_length];

/// Constants of q_nm(z), the real harmonics without (x + i y)^m:
/// Y_nm = q_n|m|(z) Re or Im (x + i y)^|m|. Holmes & Featherstone (2002):
/// q_nm = rise_nm z q_(n-1)m - fall_nm q_(n-2)m, d q_nm / dz = slope_nm
/// q_n(m+1).
struct ZonalTable
{
  Row rise[max_order + 1] = {};
  Row fall[max_order + 1] = {};
  Row slope[max_order + 1] = {};  ///< of the first derivative
  Row slope2[max_order + 1] = {}; ///< of the second derivative, q_n(m+2)
  Row diagonal = {};              ///< q_mm, no function of z
};

/// The table, made once.
const ZonalTable &zonal_table();

/// q_nm for m = 0 .. n from the rows of degrees n - 1 and n - 2, entries past
/// their degree being zero. `row` must be zero past n.
inline void next_row(const ZonalTable &table, int n, double z,
                     const double *__restrict before,
                     const double *__restrict two_before,
                     double *__restrict row)
{
  const double *rise = table.rise[n], *fall = table.fall[n];
  for (int m = 0; m < n; ++m)
    row[m] = rise[m] * z * before[m] - fall[m] * two_before[m];
  row[n] = table.diagonal[n];
}

/// Coefficients of cos(m phi) sin^m and sin(m phi) sin^m of one ring z.
struct RingSeries
{
  Row cosine = {}; ///< sum_n a_n(+m) q_nm
  Row sine = {};   ///< sum_n a_n(-m) q_nm
};

RingSeries ring_series(std::span<const double> coefficients, double z);

/// The same with derivatives by z.
struct RingDerivatives
{
  RingSeries value, first, second;
};

RingDerivatives ring_derivatives(std::span<const double> coefficients,
                                 double z);
} // namespace dem::detail
