#include "radial_samples.h"

#include <dem/shape/spherical_harmonics.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace dem::detail
{
namespace
{
/// Signed solid angle of a triangle from the origin, positive if it faces
/// outward (Van Oosterom & Strackee 1983) [sr].
double solid_angle(const Vec3 &a, const Vec3 &b, const Vec3 &c)
{
  const double la = a.norm(), lb = b.norm(), lc = c.norm();
  return 2. * std::atan2(a.dot(b.cross(c)), la * lb * lc + a.dot(b) * lc +
                                                b.dot(c) * la + c.dot(a) * lb);
}

void require_enough(std::size_t n_samples, int order)
{
  const auto n = std::size_t(n_coefficients(order));
  if (n_samples < 2 * n)
    throw std::invalid_argument(
        "mesh has " + std::to_string(n_samples) + " points: a fit of order " +
        std::to_string(order) + " from vertices needs two for each of its " +
        std::to_string(n) + " coefficients; take a lower order or rays");
}
} // namespace

RadialSamples ray_samples(const std::vector<RayHits> &hits,
                          const SphereQuadrature &rule)
{
  RadialSamples samples{rule.direction, {}, rule.weight};
  for (const RayHits &hit : hits)
    samples.radius.push_back(hit.outermost);
  return samples;
}

RadialSamples vertex_samples(const TriangleMesh &mesh)
{
  RadialSamples samples;
  for (const Vec3 &point : mesh.points)
  {
    samples.radius.push_back(point.norm());
    samples.direction.push_back(point.normalized());
  }
  samples.weight.assign(mesh.points.size(), 0.);
  std::size_t n_inward = 0;
  for (const auto &t : mesh.triangles)
  {
    const auto point = [&](std::size_t i) -> const Vec3 &
    { return mesh.points[std::size_t(t[i])]; };
    const double angle = solid_angle(point(0), point(1), point(2));
    n_inward += !(angle > 0.);
    for (const std::int32_t corner : t)
      samples.weight[std::size_t(corner)] += angle / 3.;
  }
  if (n_inward > 0)
    throw std::invalid_argument(
        "mesh is not star-shaped: " + std::to_string(n_inward) +
        " triangles do not face outward from its centroid, a fit from vertices "
        "allows none; take rays");
  return samples;
}

std::vector<double> project(const RadialSamples &samples, int order)
{
  std::vector<double> coefficients(std::size_t(n_coefficients(order)), 0.);
  std::vector<double> harmonics(coefficients.size());
  for (std::size_t k = 0; k < samples.radius.size(); ++k)
  {
    evaluate_harmonics(order, samples.direction[k], harmonics);
    for (std::size_t j = 0; j < harmonics.size(); ++j)
      coefficients[j] += samples.weight[k] * samples.radius[k] * harmonics[j];
  }
  return coefficients;
}

std::vector<double> least_squares(const RadialSamples &samples, int order)
{
  constexpr std::size_t block = 256;
  const std::size_t n_samples = samples.radius.size();
  require_enough(n_samples, order);
  const Eigen::Index n = n_coefficients(order);
  Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(n, n);
  Eigen::VectorXd right = Eigen::VectorXd::Zero(n);
  for (std::size_t first = 0; first < n_samples; first += block)
  {
    const std::size_t size = std::min(block, n_samples - first);
    Eigen::MatrixXd rows(n, Eigen::Index(size));
    for (std::size_t k = 0; k < size; ++k)
    {
      auto column = rows.col(Eigen::Index(k));
      evaluate_harmonics(order, samples.direction[first + k],
                         {column.data(), std::size_t(n)});
      column *= std::sqrt(samples.weight[first + k]);
      right += std::sqrt(samples.weight[first + k]) *
               samples.radius[first + k] * column;
    }
    normal.selfadjointView<Eigen::Lower>().rankUpdate(rows);
  }
  // near the unit matrix if the samples cover the sphere evenly
  const Eigen::LDLT<Eigen::MatrixXd> solver(normal);
  if (!(solver.vectorD().minCoeff() > 1e-8))
    throw std::invalid_argument("mesh leaves coefficients of order " +
                                std::to_string(order) +
                                " open: its points are too far apart in some "
                                "directions; take a lower order or rays");
  const Eigen::VectorXd solution = solver.solve(right);
  return {solution.begin(), solution.end()};
}
} // namespace dem::detail
