#include "gauss_legendre.h"
#include "node_fields.h"
#include "zonal_table.h"

#include <dem/assert.h>
#include <dem/shape/quadrature.h>
#include <dem/shape/spherical_harmonics.h>

#include <cmath>
#include <map>
#include <mutex>
#include <numbers>
#include <stdexcept>
#include <string>

namespace dem
{
namespace
{
void require_positive(const char *name, int value)
{
  if (value <= 0)
    throw std::invalid_argument(std::string("quadrature: ") + name + " is " +
                                std::to_string(value) + ", must be positive");
}

/// cos and sin of m phi_k, row m of all nodes of a ring.
void fill_azimuths(SphereQuadrature &rule)
{
  for (int m = 0; m <= max_order; ++m)
    for (int k = 0; k < rule.n_azimuth; ++k)
    {
      const double angle =
          2. * std::numbers::pi * ((m * k) % rule.n_azimuth) / rule.n_azimuth;
      rule.azimuth_cosine.push_back(std::cos(angle));
      rule.azimuth_sine.push_back(std::sin(angle));
    }
}

/// out_k += c cos(m phi_k) + d sin(m phi_k)
void add_order(const SphereQuadrature &rule, int m, double c, double d,
               double *__restrict out)
{
  const std::size_t start = std::size_t(m) * std::size_t(rule.n_azimuth);
  const double *__restrict cosine = rule.azimuth_cosine.data() + start;
  const double *__restrict sine = rule.azimuth_sine.data() + start;
  for (int k = 0; k < rule.n_azimuth; ++k)
    out[k] += c * cosine[k] + d * sine[k];
}

double ring_sine(double z)
{
  return std::sqrt((1. - z) * (1. + z));
}
} // namespace

SphereQuadrature make_quadrature(int n_polar, int n_azimuth)
{
  require_positive("n_polar", n_polar);
  require_positive("n_azimuth", n_azimuth);
  SphereQuadrature rule;
  rule.n_polar = n_polar;
  rule.n_azimuth = n_azimuth;
  const detail::LineRule line = detail::gauss_legendre(n_polar);
  fill_azimuths(rule);
  for (std::size_t i = 0; i < line.node.size(); ++i)
  {
    const double z = line.node[i];
    rule.ring_cosine.push_back(z);
    for (int k = 0; k < n_azimuth; ++k)
    {
      const auto index = std::size_t(n_azimuth) + std::size_t(k); // row 1
      rule.direction.emplace_back(ring_sine(z) * rule.azimuth_cosine[index],
                                  ring_sine(z) * rule.azimuth_sine[index], z);
      rule.weight.push_back(2. * std::numbers::pi * line.weight[i] / n_azimuth);
    }
  }
  return rule;
}

const SphereQuadrature &sphere_rule(int n)
{
  static std::mutex access;
  static std::map<int, SphereQuadrature> rules;
  const std::lock_guard lock(access);
  const auto known = rules.find(n);
  return known != rules.end()
             ? known->second
             : rules.emplace(n, make_quadrature(n, 2 * n)).first->second;
}

const SphereQuadrature &standard_quadrature()
{
  static const SphereQuadrature &rule = sphere_rule(40);
  return rule;
}

std::vector<double> node_radii(std::span<const double> coefficients,
                               const SphereQuadrature &rule)
{
  const int order = order_of(coefficients.size());
  DEM_ASSERT(order >= 0);
  std::vector<double> radii(rule.direction.size());
  for (int i = 0; i < rule.n_polar; ++i)
  {
    const double z = rule.ring_cosine[std::size_t(i)];
    const detail::RingSeries ring = detail::ring_series(coefficients, z);
    double *out = radii.data() + std::ptrdiff_t(i) * rule.n_azimuth;
    double power = 1.; // sin(theta)^m
    for (int m = 0; m <= order; ++m, power *= ring_sine(z))
      add_order(rule, m, power * ring.cosine[m], power * ring.sine[m], out);
  }
  return radii;
}

namespace detail
{
// dr/dtheta of sin^m q(cos theta) is m sin^(m-1) cos q - sin^(m+1) q'. The
// nodes of a Gauss rule are never at the poles, so that sin > 0.
std::vector<double> node_slopes(std::span<const double> coefficients,
                                const SphereQuadrature &rule)
{
  const int order = order_of(coefficients.size());
  const auto n_azimuth = std::size_t(rule.n_azimuth);
  std::vector<double> slopes(rule.direction.size());
  std::vector<double> polar(n_azimuth), azimuthal(n_azimuth);
  for (std::size_t i = 0; i < std::size_t(rule.n_polar); ++i)
  {
    const double z = rule.ring_cosine[i], sine = ring_sine(z);
    const RingDerivatives ring = ring_derivatives(coefficients, z);
    polar.assign(n_azimuth, 0.);
    azimuthal.assign(n_azimuth, 0.);
    double power = 1.;
    for (int m = 0; m <= order; ++m, power *= sine)
    {
      const double a = power * m / sine * z, b = -power * sine;
      const double c = power * m / sine;
      add_order(rule, m, a * ring.value.cosine[m] + b * ring.first.cosine[m],
                a * ring.value.sine[m] + b * ring.first.sine[m], polar.data());
      add_order(rule, m, c * ring.value.sine[m], -c * ring.value.cosine[m],
                azimuthal.data());
    }
    for (std::size_t k = 0; k < n_azimuth; ++k)
      slopes[i * n_azimuth + k] = std::hypot(polar[k], azimuthal[k]);
  }
  return slopes;
}
} // namespace detail
} // namespace dem
