#include "radial_samples.h"

#include <dem/shape/quadrature.h>
#include <dem/shape/recentre.h>
#include <dem/shape/spherical_harmonics.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace dem
{
namespace
{
/// The centroid is at the origin within this part of the mean radius [-].
constexpr double centred = 1e-6;
constexpr int most_rounds = 8;

/// How far the point at `from` + t s is outside the surface of a series, along
/// the ray from its origin [m].
class Outside
{
public:
  Outside(std::span<const double> of, const Vec3 &origin, const Vec3 &along)
      : series(of), from(origin), s(along)
  {
  }

  double operator()(double t) const
  {
    const Vec3 x = from + t * s;
    const double distance = x.norm();
    return distance == 0. ? -radius(series, s)
                          : distance - radius(series, x / distance);
  }

private:
  std::span<const double> series;
  Vec3 from, s;
};

/// Where the value changes its sign between two ends of different signs
/// (Illinois rule).
double root(const Outside &outside, double low, double high)
{
  double at_low = outside(low), at_high = outside(high);
  int side = 0;
  for (int step = 0; step < 100 && high - low > 1e-13 * high; ++step)
  {
    const double middle = (at_high * low - at_low * high) / (at_high - at_low);
    const double there = outside(middle);
    if (there == 0.)
      return middle;
    if (there < 0.)
    {
      low = middle;
      at_low = there;
      at_high *= side < 0 ? 0.5 : 1.;
      side = -1;
    }
    else
    {
      high = middle;
      at_high = there;
      at_low *= side > 0 ? 0.5 : 1.;
      side = 1;
    }
  }
  return 0.5 * (low + high);
}

[[noreturn]] void fail_star()
{
  throw std::invalid_argument("a ray from the centroid leaves the surface more "
                              "than once, it is not star-shaped about it");
}

/// Distance from `from` to the surface along a unit vector.
double ray_length(std::span<const double> series, const Vec3 &from,
                  const Vec3 &s, double farthest)
{
  constexpr int n_samples = 32;
  const Outside outside(series, from, s);
  double last = 0.;
  int n_crossings = 0;
  double low = 0., high = 0.;
  for (int k = 0; k <= n_samples; ++k)
  {
    const double t = farthest * k / n_samples;
    const double now = outside(t);
    if (k == 0 && !(now < 0.))
      throw std::invalid_argument("its centroid is outside its surface");
    if (k > 0 && (now < 0.) != (last < 0.))
    {
      ++n_crossings;
      low = farthest * (k - 1) / n_samples;
      high = t;
    }
    last = now;
  }
  if (n_crossings != 1)
    fail_star();
  return root(outside, low, high);
}

/// r of the surface about another origin at the nodes of the rule.
detail::RadialSamples samples_about(std::span<const double> series,
                                    const Vec3 &origin)
{
  const SphereQuadrature &rule = standard_quadrature();
  const std::vector<double> radii = node_radii(series, rule);
  const double farthest =
      1.1 * *std::max_element(radii.begin(), radii.end()) + origin.norm();
  detail::RadialSamples samples{rule.direction, {}, rule.weight};
  for (const Vec3 &s : rule.direction)
    samples.radius.push_back(ray_length(series, origin, s, farthest));
  return samples;
}

double mean_of(std::span<const double> coefficients)
{
  return coefficients[0] * equivalent_radius_factor;
}

double largest_deviation(const detail::RadialSamples &samples,
                         std::span<const double> coefficients)
{
  const std::vector<double> radii =
      node_radii(coefficients, standard_quadrature());
  double most = 0.;
  for (std::size_t k = 0; k < radii.size(); ++k)
  {
    if (!(radii[k] > 0.))
      throw std::invalid_argument("about its centroid the series has a radius "
                                  "below zero");
    most = std::max(most, std::abs(radii[k] - samples.radius[k]));
  }
  return most / mean_of(coefficients);
}
} // namespace

// V x_c = 1/4 int r^4 s.
Vec3 relative_centroid(std::span<const double> coefficients)
{
  const SphereQuadrature &rule = standard_quadrature();
  const std::vector<double> radii = node_radii(coefficients, rule);
  double volume = 0.;
  Vec3 first = Vec3::Zero();
  for (std::size_t k = 0; k < radii.size(); ++k)
  {
    const double cube = rule.weight[k] * std::pow(radii[k], 3);
    volume += cube / 3.;
    first += 0.25 * cube * radii[k] * rule.direction[k];
  }
  return first / (volume * mean_of(coefficients));
}

Recentred recentre(std::span<const double> coefficients)
{
  const int order = order_of(coefficients.size());
  Recentred result;
  result.coefficients.assign(coefficients.begin(), coefficients.end());
  for (int round = 0; round < most_rounds; ++round)
  {
    const Vec3 rest = relative_centroid(result.coefficients);
    if (rest.norm() < centred)
      break;
    result.shift += mean_of(result.coefficients) * rest;
    const detail::RadialSamples samples =
        samples_about(coefficients, result.shift);
    result.coefficients = detail::project(samples, order);
    result.deviation = largest_deviation(samples, result.coefficients);
  }
  return result;
}
} // namespace dem
