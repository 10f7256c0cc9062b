#include "log_shape.h"

#include <dem/shape/measures.h>
#include <dem/shape/quadrature.h>
#include <dem/shape/spherical_harmonics.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <numeric>

namespace dem::detail
{
namespace
{
double sphere_radius(double volume)
{
  return std::cbrt(0.75 * volume / std::numbers::pi);
}

/// Columns: the principal axes, least moment first, right-handed.
struct PrincipalFrame
{
  Mat3 axes;
  Vec3 moments; ///< rising [m^5]
};

PrincipalFrame principal_frame(const Mat3 &inertia)
{
  const Eigen::SelfAdjointEigenSolver<Mat3> solver(inertia);
  PrincipalFrame frame{solver.eigenvectors(), solver.eigenvalues()};
  frame.axes.col(2) = frame.axes.col(0).cross(frame.axes.col(1));
  return frame;
}

/// Squares of the semi-axes of the ellipsoid with these moments, but for a
/// common factor: I_x = V / 5 (b^2 + c^2), ...
Vec3 squared_axes(const Vec3 &moments)
{
  return Vec3::Constant(0.5 * moments.sum()) - moments;
}

/// log of the radius of the ellipsoid of volume 4 pi / 3 with these ratios of
/// axes.
class LogEllipsoid
{
public:
  LogEllipsoid(double log_elongation, double log_flatness)
  {
    const Vec3 logs(0., log_elongation, log_elongation + log_flatness);
    axes = (logs.array() - logs.mean()).exp();
  }
  double operator()(const Vec3 &s) const
  {
    return -std::log(s.cwiseQuotient(axes).norm());
  }

private:
  Vec3 axes;
};

/// Least squares for values at the nodes of the standard rule.
std::vector<double> project_nodes(int order, const std::vector<double> &values)
{
  const SphereQuadrature &rule = standard_quadrature();
  std::vector<double> sum(std::size_t(n_coefficients(order)), 0.);
  std::vector<double> harmonics(sum.size());
  for (std::size_t k = 0; k < rule.direction.size(); ++k)
  {
    evaluate_harmonics(order, rule.direction[k], harmonics);
    const double part = rule.weight[k] * values[k];
    for (std::size_t j = 0; j < sum.size(); ++j)
      sum[j] += part * harmonics[j];
  }
  return sum;
}

/// Nodes of the standard rule in the order of their values, and the share of
/// the directions below each.
struct Ranks
{
  std::vector<std::size_t> node;
  std::vector<double> share; ///< to the middle of the node [-]
  double mean = 0., deviation = 0.;
};

Ranks rank(const std::vector<double> &values)
{
  const std::vector<double> &weight = standard_quadrature().weight;
  Ranks ranks;
  ranks.node.resize(values.size());
  std::iota(ranks.node.begin(), ranks.node.end(), std::size_t(0));
  std::stable_sort(ranks.node.begin(), ranks.node.end(),
                   [&](std::size_t a, std::size_t b)
                   { return values[a] < values[b]; });
  double below = 0., square = 0.;
  for (const std::size_t k : ranks.node)
  {
    const double share = weight[k] / (4. * std::numbers::pi);
    ranks.share.push_back(below + 0.5 * share);
    below += share;
    ranks.mean += share * values[k];
    square += share * values[k] * values[k];
  }
  ranks.deviation = std::sqrt(std::max(0., square - ranks.mean * ranks.mean));
  return ranks;
}

Quantiles quantiles_of(const std::vector<double> &values)
{
  const Ranks ranks = rank(values);
  Quantiles quantiles = {};
  if (!(ranks.deviation > 0.)) // a constant has none
    return quantiles;
  std::size_t next = 0;
  for (std::size_t i = 0; i < quantiles.size(); ++i)
  {
    const double wanted = double(i) / double(quantiles.size() - 1);
    while (next + 1 < ranks.share.size() && ranks.share[next] < wanted)
      ++next;
    quantiles[i] = (values[ranks.node[next]] - ranks.mean) / ranks.deviation;
  }
  return quantiles;
}

/// Gives the values the quantiles, in place; rank, mean and deviation stay.
void match(std::vector<double> &values, const Quantiles &quantiles)
{
  const Ranks ranks = rank(values);
  for (std::size_t i = 0; i < ranks.node.size(); ++i)
  {
    const double rank_index = ranks.share[i] * double(quantiles.size() - 1);
    const auto low = std::min(std::size_t(rank_index), quantiles.size() - 2);
    const double part = rank_index - double(low);
    values[ranks.node[i]] =
        ranks.mean + ranks.deviation * ((1. - part) * quantiles[low] +
                                        part * quantiles[low + 1]);
  }
}

/// Moments of r over the nodes.
struct Moments
{
  double volume = 0., lowest = 0.;
  Vec3 first = Vec3::Zero();  ///< volume times centroid
  Mat3 change = Mat3::Zero(); ///< of `first` with a vector d, r + d . s
};

Moments moments_of(const std::vector<double> &radii)
{
  const SphereQuadrature &rule = standard_quadrature();
  Moments moments;
  moments.lowest = *std::min_element(radii.begin(), radii.end());
  for (std::size_t k = 0; k < radii.size(); ++k)
  {
    const Vec3 &s = rule.direction[k];
    const double cube = rule.weight[k] * std::pow(radii[k], 3);
    moments.volume += cube / 3.;
    moments.first += cube / 4. * radii[k] * s;
    moments.change += cube * s * s.transpose();
  }
  return moments;
}

/// d, such that r + d . s has its centroid nearer to the origin: a Newton step.
Vec3 to_origin(const Moments &moments)
{
  return -moments.change.ldlt().solve(moments.first);
}

/// In the first degree of the series.
void move_centroid_to_origin(Coefficients &shape)
{
  const double factor = std::sqrt(4. * std::numbers::pi / 3.); // Y_1m = x / f
  for (int step = 0; step < 8; ++step)
  {
    const Vec3 move =
        to_origin(moments_of(node_radii(shape, standard_quadrature())));
    shape[std::size_t(harmonic_index(1, 1))] += factor * move.x();
    shape[std::size_t(harmonic_index(1, -1))] += factor * move.y();
    shape[std::size_t(harmonic_index(1, 0))] += factor * move.z();
  }
}
std::vector<double> radii_of(const LogEllipsoid &ellipsoid,
                             const std::vector<double> &rest)
{
  std::vector<double> radii;
  for (std::size_t k = 0; k < rest.size(); ++k)
    radii.push_back(
        std::exp(ellipsoid(standard_quadrature().direction[k]) + rest[k]));
  return radii;
}

/// sum b_j Y_j at the nodes with the quantiles. To move the centroid changes
/// the quantiles a little, hence in turn.
std::vector<double> matched_rest(const LogShape &log,
                                 const LogEllipsoid &ellipsoid)
{
  constexpr int n_turns = 5;
  const SphereQuadrature &rule = standard_quadrature();
  std::vector<double> rest = node_radii(log.coefficients, rule);
  for (int turn = 0; turn < n_turns; ++turn)
  {
    match(rest, log.quantiles);
    const std::vector<double> radii = radii_of(ellipsoid, rest);
    const Vec3 move = to_origin(moments_of(radii));
    for (std::size_t k = 0; k < rest.size(); ++k)
      rest[k] += move.dot(rule.direction[k]) / radii[k];
  }
  return rest;
}

/// Matching makes high degrees out of low ones: scales them back.
std::vector<double> with_energy(const std::vector<double> &rest, int order,
                                double energy)
{
  std::vector<double> coefficients = project_nodes(order, rest);
  const double made = high_energy(coefficients);
  const double factor = made > 0. ? std::sqrt(energy / made) : 0.;
  for (auto j = std::size_t(n_coefficients(low_degree));
       j < coefficients.size(); ++j)
    coefficients[j] *= factor;
  return node_radii(coefficients, standard_quadrature());
}
} // namespace

double high_energy(std::span<const double> coefficients)
{
  double sum = 0.;
  for (const double b : coefficients.subspan(n_coefficients(low_degree)))
    sum += b * b;
  return sum;
}

LogShape log_shape(const Coefficients &shape, int order)
{
  const SphereQuadrature &rule = standard_quadrature();
  const ShapeMeasures of = measure_shape(shape, rule);
  const PrincipalFrame frame = principal_frame(of.inertia);
  const Vec3 squares = squared_axes(frame.moments);
  LogShape log;
  log.volume_equivalent_radius = sphere_radius(of.volume);
  log.log_elongation = 0.5 * std::log(squares.y() / squares.x());
  log.log_flatness = 0.5 * std::log(squares.z() / squares.y());
  const LogEllipsoid ellipsoid(log.log_elongation, log.log_flatness);
  std::vector<double> rest;
  for (const Vec3 &s : rule.direction)
    rest.push_back(
        std::log(radius(shape, frame.axes * s) / log.volume_equivalent_radius) -
        ellipsoid(s));
  log.coefficients = project_nodes(order, rest);
  log.quantiles = quantiles_of(node_radii(log.coefficients, rule));
  return log;
}

Coefficients from_log(const LogShape &log)
{
  const SphereQuadrature &rule = standard_quadrature();
  const int order = order_of(log.coefficients.size());
  const LogEllipsoid ellipsoid(log.log_elongation, log.log_flatness);
  const std::vector<double> rest = with_energy(
      matched_rest(log, ellipsoid), order, high_energy(log.coefficients));
  Coefficients shape = project_nodes(order, radii_of(ellipsoid, rest));
  move_centroid_to_origin(shape);
  const Moments moments = moments_of(node_radii(shape, rule));
  const double size = sphere_radius(moments.volume);
  if (!(moments.lowest > 0.05 * size))
    return {};
  for (double &a : shape)
    a *= log.volume_equivalent_radius / size;
  return shape;
}

int parity_of(int n, int m)
{
  const int order = std::abs(m);
  const bool is_x_odd = (order % 2 == 1) == (m >= 0) && m != 0;
  return (is_x_odd ? 1 : 0) + (m < 0 ? 2 : 0) + ((n + order) % 2 ? 4 : 0);
}
} // namespace dem::detail
