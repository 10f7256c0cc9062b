#pragma once

#include <vector>

namespace dem::detail
{
/// Rule on [-1, 1].
struct LineRule
{
  std::vector<double> node;   ///< increasing [-]
  std::vector<double> weight; ///< sum 2 [-]
};

/// Gauss-Legendre with n > 0 points, exact to degree 2 n - 1. Nodes by Newton
/// from the asymptotic guess (Abramowitz & Stegun 22.16.6).
LineRule gauss_legendre(int n);
} // namespace dem::detail
