#include "closed_mesh.h"
#include "radial_samples.h"
#include "ray_hits.h"

#include <dem/shape/fit.h>
#include <dem/shape/measures.h>
#include <dem/shape/quadrature.h>
#include <dem/shape/spherical_harmonics.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <stdexcept>
#include <string>

namespace dem
{
namespace
{
using detail::RadialSamples;

void require_order(int order)
{
  if (order < 1 || order > max_order)
    throw std::invalid_argument("order is " + std::to_string(order) +
                                ", must be 1 .. " + std::to_string(max_order));
}

std::string percent(double share)
{
  char text[32];
  std::snprintf(text, sizeof text, "%.3g %%", 100. * share);
  return text;
}

void require_star(const detail::ClosedMesh &closed, const ShapeFit &fit,
                  double max_overhang)
{
  const std::string overhang =
      percent(fit.overhang_fraction) +
      " of the directions from its centroid meet the surface more than once, "
      "the outermost hit alone changes the volume by " +
      percent(fit.overhang_loss);
  if (closed.n_bodies > 1)
    throw std::invalid_argument("mesh is not star-shaped: it has " +
                                std::to_string(closed.n_bodies) +
                                " separate bodies, must be one; " + overhang);
  if (fit.overhang_fraction > max_overhang)
    throw std::invalid_argument("mesh is not star-shaped: " + overhang +
                                "; at most " + percent(max_overhang) +
                                " of the directions allowed");
}

/// Share of directions and of volume that a single-valued r cannot hold.
void add_overhang(const std::vector<detail::RayHits> &hits,
                  const SphereQuadrature &rule, ShapeFit &fit)
{
  double filled = 0., missed = 0.;
  for (std::size_t k = 0; k < hits.size(); ++k)
  {
    const detail::RayHits &hit = hits[k];
    const double share = rule.weight[k] / (4. * std::numbers::pi);
    missed += hit.n_hits == 0 || hit.winding <= 0 ? share : 0.;
    fit.overhang_fraction += hit.n_hits > 1 ? share : 0.;
    filled += rule.weight[k] *
              std::abs(std::pow(hit.outermost, 3) - hit.signed_cube) / 3.;
  }
  // one lost ray would already spoil the series
  if (missed > 0.)
    throw std::invalid_argument(
        "mesh does not contain its centroid: " + percent(missed) +
        " of the directions do not leave it, it is not star-shaped");
  fit.overhang_loss = filled / fit.mesh_volume;
}

void add_residual(const RadialSamples &samples, ShapeFit &fit)
{
  const double mean = fit.coefficients[0] * equivalent_radius_factor;
  double square = 0.;
  for (std::size_t k = 0; k < samples.radius.size(); ++k)
  {
    const double residual =
        (radius(fit.coefficients, samples.direction[k]) - samples.radius[k]) /
        mean;
    square += samples.weight[k] / (4. * std::numbers::pi) * residual * residual;
    fit.residual_max = std::max(fit.residual_max, std::abs(residual));
  }
  fit.residual_rms = std::sqrt(square);
  const std::vector<double> radii =
      node_radii(fit.coefficients, standard_quadrature());
  if (!(*std::min_element(radii.begin(), radii.end()) > 0.))
    throw std::invalid_argument("mesh is too thin for this order: the series "
                                "has a radius below zero");
}
/// Largest minus smallest of a row of heights.
class Extent
{
public:
  void add(double height)
  {
    low = std::min(low, height);
    high = std::max(high, height);
  }
  double width() const { return high - low; }

private:
  double low = 0., high = 0.; // the centroid is inside
};

/// What the series misses of the volume and the length of a mesh about its
/// centroid.
void add_misfit(const TriangleMesh &mesh, ShapeFit &fit)
{
  // A needle may end between the nodes of the standard rule.
  const SphereQuadrature &rule = sphere_rule(160);
  const std::vector<double> radii = node_radii(fit.coefficients, rule);
  fit.volume_error = volume(radii, rule) / fit.mesh_volume - 1.;
  const Vec3 along = std::ranges::max_element(mesh.points, {},
                                              [](const Vec3 &point)
                                              { return point.squaredNorm(); })
                         ->normalized();
  Extent of_mesh, of_series;
  for (const Vec3 &point : mesh.points)
    of_mesh.add(point.dot(along));
  for (std::size_t k = 0; k < radii.size(); ++k)
    of_series.add(radii[k] * rule.direction[k].dot(along));
  fit.length_error = of_series.width() / of_mesh.width() - 1.;
}
} // namespace

ShapeFit fit_shape(const TriangleMesh &mesh, int order,
                   const FitOptions &options)
{
  require_order(order);
  detail::ClosedMesh closed = detail::close_mesh(mesh);
  ShapeFit fit;
  fit.centroid = closed.centroid;
  fit.mesh_volume = closed.volume;
  fit.mesh_area = closed.area;
  fit.weld_distance = closed.weld_distance;
  fit.n_welded = closed.n_welded;
  for (Vec3 &point : closed.mesh.points)
    point -= closed.centroid;
  const SphereQuadrature &rule = standard_quadrature();
  const std::vector<detail::RayHits> hits =
      detail::cast_rays(closed.mesh, rule);
  add_overhang(hits, rule, fit);
  require_star(closed, fit, options.max_overhang);
  const bool has_rays = options.samples == FitSamples::rays;
  const RadialSamples samples = has_rays ? detail::ray_samples(hits, rule)
                                         : detail::vertex_samples(closed.mesh);
  fit.coefficients = has_rays ? detail::project(samples, order)
                              : detail::least_squares(samples, order);
  add_residual(samples, fit);
  add_misfit(closed.mesh, fit);
  return fit;
}

std::vector<double>
fit_radius(const std::function<double(const Vec3 &)> &radius, int order)
{
  if (order < 0 || order > max_order)
    throw std::invalid_argument("order " + std::to_string(order) +
                                ": must be 0 to " + std::to_string(max_order));
  const SphereQuadrature &rule = standard_quadrature();
  detail::RadialSamples samples{rule.direction, {}, rule.weight};
  for (const Vec3 &direction : rule.direction)
  {
    const double r = radius(direction);
    if (!(r > 0.) || !std::isfinite(r))
      throw std::invalid_argument("radius " + std::to_string(r) +
                                  ": must be positive and finite");
    samples.radius.push_back(r);
  }
  return detail::project(samples, order);
}
} // namespace dem
