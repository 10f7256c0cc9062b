#include <dem/assert.h>
#include <dem/shape/measures.h>
#include <dem/shape/patch.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace dem
{
namespace
{
/// Sums over the nodes with kappa_max r_ins > 1.
struct CornerSums
{
  double area = 0.;          ///< of all nodes [m^2]
  double corner_area = 0.;   ///< of nodes with g = 1 [m^2]
  double corner_radius = 0.; ///< area times 1 / kappa_max there [m^3]
  double saddle_angle = 0.;  ///< of nodes with kappa_min < 0 [sr]
  double max_slope = 0.;     ///< [m]
  double max_curvature = 0.; ///< [1/m]
};

CornerSums corner_sums(std::span<const double> coefficients,
                       const SphereQuadrature &rule, double inscribed_radius)
{
  CornerSums sums;
  std::vector<RadialExpansion> expansions(rule.direction.size());
  expand(coefficients, rule.direction, expansions);
  for (std::size_t k = 0; k < rule.direction.size(); ++k)
  {
    const RadialExpansion &at = expansions[k];
    const double slope = at.gradient.norm();
    const double area =
        rule.weight[k] * at.radius * std::hypot(at.radius, slope);
    const PrincipalCurvatures kappa = principal_curvatures(at);
    const double curvature = kappa.maximum;
    sums.area += area;
    sums.saddle_angle += kappa.minimum < 0. ? rule.weight[k] : 0.;
    sums.max_slope = std::max(sums.max_slope, slope);
    sums.max_curvature = std::max(sums.max_curvature, curvature);
    if (is_corner(curvature, inscribed_radius))
    {
      sums.corner_area += area;
      sums.corner_radius += area / curvature;
    }
  }
  return sums;
}

double roundness_of(const CornerSums &sums, double inscribed_radius)
{
  return sums.corner_area > 0.
             ? sums.corner_radius / (sums.corner_area * inscribed_radius)
             : 1.;
}

/// Volume, centroid and inertia from the moments of r.
void add_moments(std::span<const double> radii, const SphereQuadrature &rule,
                 ShapeMeasures &measures)
{
  Vec3 first = Vec3::Zero();
  Mat3 second = Mat3::Zero();
  for (std::size_t k = 0; k < radii.size(); ++k)
  {
    const double cube = rule.weight[k] * std::pow(radii[k], 3);
    const Vec3 x = radii[k] * rule.direction[k];
    measures.volume += cube / 3.;
    first += cube / 4. * x;
    second += cube / 5. * x * x.transpose();
  }
  measures.centroid = first / measures.volume;
  second -= measures.volume * measures.centroid * measures.centroid.transpose();
  measures.inertia = second.trace() * Mat3::Identity() - second;
}
} // namespace

ShapeMeasures measure_shape(std::span<const double> coefficients,
                            const SphereQuadrature &rule)
{
  const std::vector<double> radii = node_radii(coefficients, rule);
  ShapeMeasures measures;
  add_moments(radii, rule, measures);
  const auto [lowest, highest] =
      std::minmax_element(radii.begin(), radii.end());
  measures.inscribed_radius = *lowest;
  measures.circumscribed_radius = *highest;
  measures.mean_radius = coefficients[0] * equivalent_radius_factor;
  const CornerSums sums = corner_sums(coefficients, rule, *lowest);
  measures.area = sums.area;
  measures.max_slope = sums.max_slope;
  measures.max_curvature = sums.max_curvature;
  measures.sphericity =
      std::cbrt(36. * std::numbers::pi * std::pow(measures.volume, 2)) /
      sums.area;
  measures.saddle_fraction = sums.saddle_angle / (4. * std::numbers::pi);
  measures.corner_fraction = sums.corner_area / sums.area;
  measures.roundness = roundness_of(sums, *lowest);
  return measures;
}

double volume(std::span<const double> radii, const SphereQuadrature &rule)
{
  DEM_ASSERT(radii.size() == rule.weight.size());
  double sum = 0.;
  for (std::size_t k = 0; k < radii.size(); ++k)
    sum += rule.weight[k] * radii[k] * radii[k] * radii[k];
  return sum / 3.;
}

bool is_corner(double max_curvature, double inscribed_radius)
{
  return max_curvature * inscribed_radius > 1. + 1e-3;
}

double roundness(std::span<const double> coefficients,
                 const SphereQuadrature &rule)
{
  const std::vector<double> radii = node_radii(coefficients, rule);
  const double inscribed = *std::min_element(radii.begin(), radii.end());
  return roundness_of(corner_sums(coefficients, rule, inscribed), inscribed);
}
} // namespace dem
