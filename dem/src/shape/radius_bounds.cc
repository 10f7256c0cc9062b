#include <dem/assert.h>
#include <dem/shape/radius_bounds.h>
#include <dem/shape/spherical_harmonics.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <vector>

namespace dem
{
namespace
{
/// What is left between a bound and the largest value found.
constexpr double radius_tolerance = 5e-3; // of the largest radius
constexpr double slope_tolerance = 8e-2;  // of the largest slope
/// Cells are halved at most so often: each time their rest falls to a quarter.
constexpr int most_levels = 12;

/// A rectangle of polar angle and azimuth round the direction of its value.
struct Cell
{
  double polar = 0., azimuth = 0.;           ///< of that direction [rad]
  double half_polar = 0., half_azimuth = 0.; ///< to its sides [rad]
  double value = 0.;

  /// No point of the cell is farther from its direction: along a straight line
  /// in both angles the way is at most this, with the largest sine [rad].
  double reach() const
  {
    const double low = std::max(0., polar - half_polar),
                 high = std::min(std::numbers::pi, polar + half_polar);
    const double half_pi = 0.5 * std::numbers::pi;
    const double sine = low <= half_pi && high >= half_pi
                            ? 1.
                            : std::max(std::sin(low), std::sin(high));
    return std::hypot(half_polar, sine * half_azimuth);
  }

  Vec3 direction() const
  {
    return {std::sin(polar) * std::cos(azimuth),
            std::sin(polar) * std::sin(azimuth), std::cos(polar)};
  }

  /// No value of the cell is larger if its largest one is a maximum and second
  /// derivatives are at most `second`.
  double bound(double second) const
  {
    const double d = reach();
    return value + 0.5 * d * d * second;
  }
};

using Cells = std::vector<Cell>;
using Values = std::function<double(const RadialExpansion &)>;

/// Cells round the nodes that together hold all directions.
Cells cells_of(const SphereQuadrature &rule, std::span<const double> values)
{
  const auto n_azimuth = static_cast<std::size_t>(rule.n_azimuth);
  const auto n_polar = static_cast<std::size_t>(rule.n_polar);
  std::vector<double> polar(n_polar);
  for (std::size_t i = 0; i < n_polar; ++i)
    polar[i] = std::acos(rule.ring_cosine[i]);
  // Rings may come from either pole.
  const bool is_falling = polar.front() > polar.back();
  const double first = is_falling ? std::numbers::pi : 0.,
               last = std::numbers::pi - first;
  Cells cells;
  cells.reserve(values.size());
  for (std::size_t i = 0; i < n_polar; ++i)
  {
    const double before = i == 0 ? first : 0.5 * (polar[i] + polar[i - 1]),
                 after =
                     i + 1 == n_polar ? last : 0.5 * (polar[i] + polar[i + 1]);
    const double half =
        std::max(std::abs(before - polar[i]), std::abs(after - polar[i]));
    for (std::size_t k = 0; k < n_azimuth; ++k)
      cells.push_back({polar[i],
                       2. * std::numbers::pi * double(k) / double(n_azimuth),
                       half, std::numbers::pi / double(n_azimuth),
                       values[i * n_azimuth + k]});
  }
  return cells;
}

/// The four quarters of each cell, without their values.
Cells quarters(const Cells &cells)
{
  Cells parts;
  parts.reserve(4 * cells.size());
  for (const Cell &cell : cells)
    for (const double down : {-0.5, 0.5})
      for (const double right : {-0.5, 0.5})
        parts.push_back({cell.polar + down * cell.half_polar,
                         cell.azimuth + right * cell.half_azimuth,
                         0.5 * cell.half_polar, 0.5 * cell.half_azimuth, 0.});
  return parts;
}

/// A bound of the largest value over all directions, with cells that hold them
/// all; it is within `tolerance` of a value that is taken.
double upper_bound(std::span<const double> coefficients, Cells cells,
                   const Values &value_of, double second, double tolerance)
{
  double best = -std::numeric_limits<double>::infinity();
  double closed = best; // largest bound of cells that need no look
  for (int level = 0;; ++level)
  {
    for (const Cell &cell : cells)
      best = std::max(best, cell.value);
    Cells open;
    for (const Cell &cell : cells)
      if (const double bound = cell.bound(second);
          bound > best + tolerance && level < most_levels)
        open.push_back(cell);
      else
        closed = std::max(closed, bound);
    if (open.empty())
      return std::max(best, closed);
    cells = quarters(open);
    std::vector<Vec3> directions;
    directions.reserve(cells.size());
    for (const Cell &cell : cells)
      directions.push_back(cell.direction());
    std::vector<RadialExpansion> expansions(cells.size());
    expand(coefficients, directions, expansions);
    for (std::size_t k = 0; k < cells.size(); ++k)
      cells[k].value = value_of(expansions[k]);
  }
}

std::vector<double> negative(std::span<const double> values)
{
  std::vector<double> all(values.begin(), values.end());
  for (double &value : all)
    value = -value;
  return all;
}
} // namespace

// P_n(cos t) = 1 - l/4 t^2 + l (3 l - 2)/192 t^4 - ..., l = n (n + 1), from
// y'' + cot(t) y' + l y = 0.
DerivativeBounds derivative_bounds(std::span<const double> coefficients)
{
  const int order = order_of(coefficients.size());
  DEM_ASSERT(order >= 0);
  DerivativeBounds bounds;
  for (int n = 0; n <= order; ++n)
  {
    double square = 0.;
    for (int m = -n; m <= n; ++m)
    {
      const double a = coefficients[std::size_t(harmonic_index(n, m))];
      square += a * a;
    }
    const double l = n * (n + 1.);
    // y = 1 + a t^2 + b t^4 + c t^6 with cot t = 1/t - t/3 - t^3/45.
    const double a = -0.25 * l, b = a * (2. / 3. - l) / 16.,
                 c = (2. / 45. * a + (4. / 3. - l) * b) / 36.;
    const double size =
        std::sqrt(square * (2. * n + 1.) * 0.25 * std::numbers::inv_pi);
    bounds.value += size;
    bounds.first += size * std::sqrt(-2. * a);
    bounds.second += size * std::sqrt(24. * b);
    bounds.third += size * std::sqrt(-720. * c);
  }
  return bounds;
}

RadiusBounds radius_bounds(std::span<const double> coefficients,
                           const SphereQuadrature &rule,
                           std::span<const double> radii,
                           std::span<const double> slopes)
{
  const DerivativeBounds second = derivative_bounds(coefficients);
  const double tolerance =
      radius_tolerance * *std::max_element(radii.begin(), radii.end());
  RadiusBounds bounds;
  bounds.largest = upper_bound(
      coefficients, cells_of(rule, radii),
      [](const RadialExpansion &at) { return at.radius; }, second.second,
      tolerance);
  bounds.smallest = -upper_bound(
      coefficients, cells_of(rule, negative(radii)),
      [](const RadialExpansion &at) { return -at.radius; }, second.second,
      tolerance);
  // t.grad r with t carried along a great circle: its second derivative is the
  // symmetric third derivative of r but for a third of its gradient, which the
  // curvature of the sphere leaves where directions are exchanged.
  bounds.slope = std::min(
      second.first,
      upper_bound(
          coefficients, cells_of(rule, slopes),
          [](const RadialExpansion &at) { return at.gradient.norm(); },
          second.third + second.first / 3.,
          slope_tolerance * *std::max_element(slopes.begin(), slopes.end())));
  return bounds;
}
} // namespace dem
