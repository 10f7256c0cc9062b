#include "closed_mesh.h"
#include "ray_hits.h"

#include <dem/shape/fit.h>
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

/// a_j = sum_k w_k r_k Y_j(s_k): least squares, as the harmonics are
/// orthonormal under the rule.
std::vector<double> project(const std::vector<detail::RayHits> &hits,
                            const SphereQuadrature &rule, int order)
{
  std::vector<double> coefficients(std::size_t(n_coefficients(order)), 0.);
  std::vector<double> harmonics(coefficients.size());
  for (std::size_t k = 0; k < hits.size(); ++k)
  {
    evaluate_harmonics(order, rule.direction[k], harmonics);
    for (std::size_t j = 0; j < harmonics.size(); ++j)
      coefficients[j] += rule.weight[k] * hits[k].outermost * harmonics[j];
  }
  return coefficients;
}

void add_residual(const std::vector<detail::RayHits> &hits,
                  const SphereQuadrature &rule, ShapeFit &fit)
{
  const std::vector<double> radii = node_radii(fit.coefficients, rule);
  const double mean = fit.coefficients[0] * ball_radius_factor;
  double square = 0.;
  for (std::size_t k = 0; k < hits.size(); ++k)
  {
    const double residual = (radii[k] - hits[k].outermost) / mean;
    square += rule.weight[k] / (4. * std::numbers::pi) * residual * residual;
    fit.residual_max = std::max(fit.residual_max, std::abs(residual));
  }
  fit.residual_rms = std::sqrt(square);
  if (!(*std::min_element(radii.begin(), radii.end()) > 0.))
    throw std::invalid_argument("mesh is too thin for this order: the series "
                                "has a radius below zero");
}
} // namespace

ShapeFit fit_shape(const TriangleMesh &mesh, int order, double max_overhang)
{
  require_order(order);
  detail::ClosedMesh closed = detail::close_mesh(mesh);
  ShapeFit fit;
  fit.centroid = closed.centroid;
  fit.mesh_volume = closed.volume;
  fit.mesh_area = closed.area;
  for (Vec3 &point : closed.mesh.points)
    point -= closed.centroid;
  const SphereQuadrature &rule = standard_quadrature();
  const std::vector<detail::RayHits> hits =
      detail::cast_rays(closed.mesh, rule);
  add_overhang(hits, rule, fit);
  require_star(closed, fit, max_overhang);
  fit.coefficients = project(hits, rule, order);
  add_residual(hits, rule, fit);
  return fit;
}
} // namespace dem
