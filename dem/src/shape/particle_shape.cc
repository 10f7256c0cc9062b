#include "node_fields.h"

#include <dem/assert.h>
#include <dem/shape/form.h>
#include <dem/shape/measures.h>
#include <dem/shape/particle_shape.h>
#include <dem/shape/radius_bounds.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>

namespace dem
{
namespace
{
// Bounds farther than this from the values at the nodes are computed again, in
// parts of the largest radius and of the largest slope at a node.
constexpr double loose_radius = 0.03;
constexpr double loose_slope = 0.25;

double equivalent_radius(const Coefficients &coefficients)
{
  return coefficients[0] * equivalent_radius_factor;
}

void require_order(const Coefficients &coefficients)
{
  if (order_of(coefficients.size()) < 0)
    throw std::invalid_argument(
        "shape: " + std::to_string(coefficients.size()) +
        " coefficients, must be (order + 1)^2 with order 0 .. " +
        std::to_string(max_order));
}

/// Principal moments over the mass, from 1/5 int r^5 s s^T.
void set_gyration(std::span<const double> radii, const SphereQuadrature &rule,
                  ParticleShape &body)
{
  Mat3 second = Mat3::Zero();
  for (std::size_t k = 0; k < radii.size(); ++k)
  {
    const Vec3 x = radii[k] * rule.direction[k];
    second += rule.weight[k] / 5. * radii[k] * radii[k] * radii[k] * x *
              x.transpose();
  }
  second /= body.volume;
  const Eigen::SelfAdjointEigenSolver<Mat3> axes(
      second.trace() * Mat3::Identity() - second);
  Mat3 frame = axes.eigenvectors();
  if (frame.determinant() < 0.)
    frame.col(0) *= -1.;
  body.gyration = axes.eigenvalues();
  body.principal = Quaternion(frame).normalized();
}

/// Radius and slope at the nodes of a rule, and their extremes.
struct NodeFields
{
  std::vector<double> radii, slopes;
  double lowest = 0., highest = 0., steepest = 0.;

  NodeFields(const Coefficients &coefficients, const SphereQuadrature &rule)
      : radii(node_radii(coefficients, rule)),
        slopes(detail::node_slopes(coefficients, rule))
  {
    const auto [low, high] = std::minmax_element(radii.begin(), radii.end());
    lowest = *low;
    highest = *high;
    steepest = *std::max_element(slopes.begin(), slopes.end());
  }

  RadiusBounds bounds(const Coefficients &coefficients,
                      const SphereQuadrature &rule) const
  {
    return radius_bounds(coefficients, rule, radii, slopes);
  }

  bool are_loose(const RadiusBounds &bounds) const
  {
    return !(bounds.smallest > 0.) ||
           bounds.largest > (1. + loose_radius) * highest ||
           bounds.smallest < lowest - loose_radius * highest ||
           bounds.slope > (1. + loose_slope) * steepest;
  }
};

/// Everything but the series and the bounds, from the nodes.
ParticleShape measured(const NodeFields &nodes, const SphereQuadrature &rule)
{
  ParticleShape body;
  body.volume = volume(nodes.radii, rule);
  body.inscribed_radius = body.corner_radius = nodes.lowest;
  set_gyration(nodes.radii, rule, body);
  return body;
}

void set_bounds(const RadiusBounds &bounds, ParticleShape &body)
{
  body.circumscribed_radius = bounds.largest;
  body.least_radius = bounds.smallest;
  body.max_slope = bounds.slope;
}

ParticleShape measured(const Coefficients &coefficients,
                       const SphereQuadrature &rule)
{
  const NodeFields nodes(coefficients, rule);
  ParticleShape body = measured(nodes, rule);
  set_bounds(nodes.bounds(coefficients, rule), body);
  return body;
}

/// What the bounds of a shape become by the largest change there can be.
RadiusBounds widened(const ParticleShape &before, const Coefficients &after)
{
  Coefficients change = scaled_coefficients(before);
  change.resize(after.size(), 0.);
  for (std::size_t j = 0; j < change.size(); ++j)
    change[j] -= after[j];
  const DerivativeBounds most = derivative_bounds(change);
  return {before.circumscribed_radius + most.value,
          before.least_radius - most.value, before.max_slope + most.first};
}
} // namespace

ParticleShape make_sphere(double radius)
{
  ParticleShape body;
  body.scale = radius;
  body.volume = 4. / 3. * std::numbers::pi * std::pow(radius, 3);
  body.inscribed_radius = body.corner_radius = radius;
  body.circumscribed_radius = body.least_radius = radius;
  body.gyration.setConstant(0.4 * radius * radius);
  return body;
}

ParticleShape make_shape(std::shared_ptr<const Coefficients> series,
                         double radius, const SphereQuadrature &rule)
{
  DEM_ASSERT(series);
  require_order(*series);
  ParticleShape unit = measured(*series, rule);
  unit.series = std::move(series);
  return resized(unit, radius);
}

ParticleShape resized(const ParticleShape &body, double radius)
{
  const double factor = radius / mean_radius(body);
  ParticleShape result = body;
  result.scale *= factor;
  result.volume *= std::pow(factor, 3);
  result.inscribed_radius *= factor;
  result.corner_radius *= factor;
  result.circumscribed_radius *= factor;
  result.least_radius *= factor;
  result.max_slope *= factor;
  result.gyration *= factor * factor;
  return result;
}

ParticleShape shape_of(Coefficients coefficients, const SphereQuadrature &rule)
{
  require_order(coefficients);
  ParticleShape body = measured(coefficients, rule);
  body.series = std::make_shared<const Coefficients>(std::move(coefficients));
  return body;
}

ParticleShape changed_shape(const ParticleShape &before,
                            Coefficients coefficients,
                            const SphereQuadrature &rule)
{
  require_order(coefficients);
  const NodeFields nodes(coefficients, rule);
  ParticleShape body = measured(nodes, rule);
  const RadiusBounds bounds = widened(before, coefficients);
  set_bounds(nodes.are_loose(bounds) ? nodes.bounds(coefficients, rule)
                                     : bounds,
             body);
  body.series = std::make_shared<const Coefficients>(std::move(coefficients));
  return body;
}

void free_corner_radius(ParticleShape &body, const SphereQuadrature &rule)
{
  if (body.series)
    body.corner_radius =
        body.scale * inscribed_sphere(*body.series, rule).radius;
}

double mean_radius(const ParticleShape &body)
{
  return body.series ? body.scale * equivalent_radius(*body.series)
                     : body.scale;
}

Coefficients scaled_coefficients(const ParticleShape &body)
{
  if (!body.series)
    return {body.scale / equivalent_radius_factor};
  Coefficients coefficients = *body.series;
  for (double &a : coefficients)
    a *= body.scale;
  return coefficients;
}
} // namespace dem
