#pragma once

#include <dem/shape/quadrature.h>

#include <span>

namespace dem
{
/// Bounds of the radius r of a series over all directions. They are derived
/// from the coefficients and hold between any samples.
struct RadiusBounds
{
  double largest = 0.;  ///< r <= largest [m]
  double smallest = 0.; ///< r >= smallest [m]
  double slope = 0.;    ///< |grad_S r| <= slope [m]
};

/// Bounds of a series and of its derivatives along great circles from the
/// energy of each degree alone: by the addition theorem the k-th derivative of
/// the part of degree n is at most sqrt(sum_m a_nm^2 (2 n + 1) / (4 pi) p_k),
/// with p_k the derivative of order 2 k of P_n(cos t) at t = 0, up to its sign.
struct DerivativeBounds
{
  double value = 0.;  ///< |r| [m]
  double first = 0.;  ///< |dr/dt| [m]
  double second = 0.; ///< |d^2 r/dt^2| [m]
  double third = 0.;  ///< |d^3 r/dt^3| [m]
};

DerivativeBounds derivative_bounds(std::span<const double> coefficients);

/// Bounds by branch and bound over cells round the nodes of the rule. A cell
/// with the largest r in it has r(node) >= largest - d^2 / 2 max|r''|, where d
/// is the distance of its farthest corner; cells that could hold more than is
/// found are divided. `largest` and `smallest` are within 0.5 % of the largest
/// radius of what they bound, `slope` is within 8 % of the largest slope.
/// `radii` and `slopes` are those of the nodes.
RadiusBounds radius_bounds(std::span<const double> coefficients,
                           const SphereQuadrature &rule,
                           std::span<const double> radii,
                           std::span<const double> slopes);
} // namespace dem
