#include <dem/shape/quadrature.h>
#include <dem/shape/ringing.h>
#include <dem/shape/spherical_harmonics.h>

#include <algorithm>
#include <cmath>

namespace dem
{
// The harmonics are orthonormal: the mean of (sum a_j Y_j)^2 over the sphere is
// sum a_j^2 / (4 pi), that of the mean radius a_00^2 / (4 pi).
Ringing ringing(std::span<const double> coefficients)
{
  const int order = order_of(coefficients.size());
  std::vector<double> upper(coefficients.begin(), coefficients.end());
  const int first = 2 * order / 3 + 1;
  std::fill_n(upper.begin(), n_coefficients(first - 1), 0.);
  double square = 0., largest = 0.;
  for (const double a : upper)
    square += a * a;
  for (const double r : node_radii(upper, standard_quadrature()))
    largest = std::max(largest, std::abs(r));
  return {std::sqrt(square) / coefficients[0],
          largest / (coefficients[0] * equivalent_radius_factor)};
}
} // namespace dem
