#include "../shape/gauss_legendre.h"

#include <dem/assert.h>
#include <dem/breakage/update.h>
#include <dem/shape/measures.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace dem
{
namespace
{
/// theta k_n Y_nm(u) / theta: coefficients of the zonal kernel around u.
Coefficients kernel_coefficients(double width, int order, const Vec3 &u)
{
  const std::vector<double> spectrum = kernel_spectrum(width, order);
  Coefficients kernel(std::size_t(n_coefficients(order)));
  evaluate_harmonics(order, u, kernel);
  for (int n = 0; n <= order; ++n)
    for (int m = -n; m <= n; ++m)
      kernel[std::size_t(harmonic_index(n, m))] *= spectrum[std::size_t(n)];
  return kernel;
}

/// V(r) - V(r - theta K) = first theta - second theta^2 + third theta^3.
struct RemovedVolume
{
  double first = 0.;  ///< int r^2 K [m^2]
  double second = 0.; ///< int r K^2 [m]
  double third = 0.;  ///< 1/3 int K^3 [-]

  double value(double theta) const
  {
    return theta * (first - theta * (second - theta * third));
  }
  double slope(double theta) const
  {
    return first - theta * (2. * second - theta * 3. * third);
  }
};

RemovedVolume removed_volume(std::span<const double> radii,
                             std::span<const double> kernel,
                             const SphereQuadrature &rule)
{
  RemovedVolume removed;
  for (std::size_t k = 0; k < radii.size(); ++k)
  {
    const double r = radii[k], value = kernel[k], weight = rule.weight[k];
    removed.first += weight * r * r * value;
    removed.second += weight * r * value * value;
    removed.third += weight * value * value * value / 3.;
  }
  return removed;
}

/// The depth that removes this volume; negative if there is none.
double solve_depth(const RemovedVolume &removed, double volume)
{
  double theta = volume / removed.first;
  for (int step = 0; step < 50; ++step)
  {
    const double slope = removed.slope(theta);
    if (!(slope > 0.)) // past the largest volume this kernel can remove
      return -1.;
    const double change = (removed.value(theta) - volume) / slope;
    theta -= change;
    if (std::abs(change) <= 1e-15 * std::abs(theta))
      return theta;
  }
  // round-off keeps the last digit moving: accept what is closed well enough
  return std::abs(removed.value(theta) - volume) <= 1e-12 * volume ? theta
                                                                   : -1.;
}

/// docs/theory/breakage.md, The new shape.
double exact_depth(const Coefficients &coefficients, const Coefficients &kernel,
                   double volume, const SphereQuadrature &rule)
{
  return solve_depth(removed_volume(node_radii(coefficients, rule),
                                    node_radii(kernel, rule), rule),
                     volume);
}

/// V_i / (r_0^2 int K): on a sphere, to first order, what Eq. 17 takes off the
/// mean radius.
double article_depth(const Coefficients &coefficients,
                     const Coefficients &kernel, double volume)
{
  const double mean = coefficients[0] * equivalent_radius_factor;
  return volume / (mean * mean * kernel[0] / equivalent_radius_factor);
}

/// a_00 after Eqs. 17, 18; negative if the sphere has less than this volume.
double article_mean(double a_00, double volume)
{
  const double mean = a_00 * equivalent_radius_factor;
  return std::cbrt(std::pow(mean, 3) - 0.75 * volume / std::numbers::pi) /
         equivalent_radius_factor;
}
} // namespace

double kernel_width(const Spall &spall, double contact_radius, int order,
                    const KernelRule &rule)
{
  DEM_ASSERT(order > 0 && contact_radius > 0.);
  const double patch =
      rule.scale *
      std::sqrt(spall.overlap / std::sqrt(spall.gaussian_curvature)) /
      contact_radius;
  return std::min(std::max(patch, rule.floor / order), 0.25 * std::numbers::pi);
}

// Beyond nine widths the Gaussian is below 3e-18. 128 points resolve P_30 on
// the whole range (15 periods) to round-off.
std::vector<double> kernel_spectrum(double width, int order)
{
  static const detail::LineRule line = detail::gauss_legendre(128);
  const double half_range = 0.5 * std::min(std::numbers::pi, 9. * width);
  std::vector<double> spectrum(std::size_t(order) + 1, 0.);
  for (std::size_t k = 0; k < line.node.size(); ++k)
  {
    const double gamma = half_range * (1. + line.node[k]);
    const double x = std::cos(gamma);
    const double weight = 2. * std::numbers::pi * half_range * line.weight[k] *
                          std::sin(gamma) *
                          std::exp(-0.5 * std::pow(gamma / width, 2));
    double before = 0., legendre = 1.;
    for (int n = 0; n <= order; ++n)
    {
      spectrum[std::size_t(n)] += weight * legendre;
      const double next =
          ((2. * n + 1.) * x * legendre - n * before) / (n + 1.);
      before = legendre;
      legendre = next;
    }
  }
  return spectrum;
}

SpallResult apply_spall(const ParticleShape &body, const Spall &spall,
                        const KernelRule &shape, const SphereQuadrature &rule)
{
  SpallResult result;
  result.body = body;
  if (!body.series || body.series->size() < 2) // a sphere has no corner
    return result;
  Coefficients coefficients = scaled_coefficients(body);
  const int order = order_of(coefficients.size());
  result.width =
      kernel_width(spall, radius(coefficients, spall.direction), order, shape);
  const Coefficients kernel =
      kernel_coefficients(result.width, order, spall.direction);
  const bool is_exact = shape.closure == DepthClosure::exact;
  result.depth = is_exact
                     ? exact_depth(coefficients, kernel, spall.volume, rule)
                     : article_depth(coefficients, kernel, spall.volume);
  if (!(result.depth >= 0.))
    return result;
  const double mean = coefficients[0];
  for (std::size_t j = 0; j < kernel.size(); ++j)
    coefficients[j] -= result.depth * kernel[j];
  if (!is_exact)
    coefficients[0] = article_mean(mean, spall.volume);
  ParticleShape after = changed_shape(body, std::move(coefficients), rule);
  if (!(after.least_radius > 0.))
    return result;
  if (shape.inscribed == InscribedSphereAt::free)
    free_corner_radius(after, rule);
  result.removed_volume = body.volume - after.volume;
  result.body = std::move(after);
  result.is_accepted = true;
  return result;
}
} // namespace dem
