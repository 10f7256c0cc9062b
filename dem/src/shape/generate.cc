#include "log_shape.h"

#include <dem/shape/generate.h>
#include <dem/shape/spherical_harmonics.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>

namespace dem
{
namespace
{
using detail::high_energy;
using detail::LogShape;
using detail::low_degree;

constexpr int n_parities = 8;
/// Energy that no particle has: keeps the logarithm of a sphere's finite.
constexpr double smooth = 1e-20;

double energy(const std::vector<double> &logs, int n)
{
  double sum = 0.;
  for (int m = -n; m <= n; ++m)
    sum += std::pow(logs[std::size_t(harmonic_index(n, m))], 2);
  return sum;
}

/// Indices of values that are no coefficients.
enum Extra
{
  roughness = -1, ///< log of the amplitude of the high degrees
  elongation = -2,
  flatness = -3
};

double value_at(const LogShape &log, int index)
{
  switch (index)
  {
  case roughness:
    return 0.5 * std::log(smooth + high_energy(log.coefficients));
  case elongation:
    return log.log_elongation;
  case flatness:
    return log.log_flatness;
  default:
    return log.coefficients[std::size_t(index)];
  }
}

/// Box and Muller (1958), one number of the two.
double normal_number(Random &random)
{
  const double radius = std::sqrt(-2. * std::log(1. - random.uniform()));
  return radius * std::cos(2. * std::numbers::pi * random.uniform());
}

/// A root of the covariance. Rows are particles, columns what is drawn
/// together, both free of their mean. Off the diagonal the covariance is shrunk
/// by n / (n
/// + d), as few particles make many correlations.
Eigen::MatrixXd covariance_root(const Eigen::MatrixXd &rows, bool has_mean)
{
  const auto n = double(rows.rows()), d = double(rows.cols());
  const Eigen::MatrixXd full =
      rows.transpose() * rows / (has_mean ? n - 1. : n);
  const Eigen::MatrixXd diagonal = full.diagonal().asDiagonal();
  const double keep = n / (n + d);
  // a root by eigenvalues, as some may be zero
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(
      keep * full + (1. - keep) * diagonal);
  return solver.eigenvectors() *
         solver.eigenvalues().cwiseMax(0.).cwiseSqrt().asDiagonal();
}

void require(bool is_met, const std::string &what)
{
  if (!is_met)
    throw std::invalid_argument("generate: " + what);
}
} // namespace

ShapeGenerator::ShapeGenerator(std::span<const Coefficients> sample,
                               int order_of_particles)
    : order(order_of_particles)
{
  require(sample.size() >= 3, "the sample has " +
                                  std::to_string(sample.size()) +
                                  " shapes, must be at least 3");
  require(order > low_degree && order <= max_order,
          "the order is " + std::to_string(order) + ", must be " +
              std::to_string(low_degree + 1) + " .. " +
              std::to_string(max_order));
  std::vector<LogShape> logs;
  quantiles.assign(std::tuple_size_v<detail::Quantiles>, 0.);
  double log_radius = 0.;
  for (const Coefficients &shape : sample)
  {
    require(order_of(shape.size()) >= low_degree,
            "a shape of the sample has an order below " +
                std::to_string(low_degree));
    logs.push_back(detail::log_shape(shape, order));
    for (std::size_t i = 0; i < quantiles.size(); ++i)
      quantiles[i] += logs.back().quantiles[i] / double(sample.size());
    log_radius +=
        std::log(logs.back().volume_equivalent_radius) / double(sample.size());
  }
  radius = std::exp(log_radius);
  for (int parity = 0; parity < n_parities; ++parity)
    classes.push_back(fit_class(logs, parity));
  fit_spectrum(logs);
}

ShapeGenerator::Normal
ShapeGenerator::fit_class(const std::vector<detail::LogShape> &logs,
                          int parity) const
{
  Normal normal;
  for (int n = 1; n <= low_degree; ++n)
    for (int m = -n; m <= n; ++m)
      if (detail::parity_of(n, m) == parity)
        normal.index.push_back(harmonic_index(n, m));
  if (parity == 0)
    normal.index.insert(normal.index.end(), {roughness, elongation, flatness});
  Eigen::MatrixXd rows(Eigen::Index(logs.size()),
                       Eigen::Index(normal.index.size()));
  for (Eigen::Index k = 0; k < rows.rows(); ++k)
    for (Eigen::Index i = 0; i < rows.cols(); ++i)
      rows(k, i) = value_at(logs[std::size_t(k)], normal.index[std::size_t(i)]);
  normal.mean = Eigen::VectorXd::Zero(rows.cols());
  if (parity == 0)
    normal.mean = rows.colwise().mean();
  rows.rowwise() -= normal.mean.transpose();
  normal.factor = covariance_root(rows, parity == 0);
  return normal;
}

void ShapeGenerator::fit_spectrum(const std::vector<detail::LogShape> &logs)
{
  spectrum.assign(std::size_t(order) + 1, 0.);
  for (const LogShape &log : logs)
    for (int n = low_degree + 1; n <= order; ++n)
      spectrum[std::size_t(n)] += energy(log.coefficients, n) /
                                  high_energy(log.coefficients) /
                                  double(logs.size());
}

detail::LogShape ShapeGenerator::draw(Random &random) const
{
  LogShape log;
  log.volume_equivalent_radius = radius;
  std::copy(quantiles.begin(), quantiles.end(), log.quantiles.begin());
  log.coefficients.assign(std::size_t(n_coefficients(order)), 0.);
  double amplitude = 0.;
  for (const Normal &normal : classes)
  {
    Eigen::VectorXd numbers(normal.mean.size());
    for (double &number : numbers)
      number = normal_number(random);
    const Eigen::VectorXd drawn = normal.mean + normal.factor * numbers;
    for (Eigen::Index i = 0; i < drawn.size(); ++i)
      switch (const int index = normal.index[std::size_t(i)]; index)
      {
      case roughness:
        amplitude = std::exp(drawn[i]);
        break;
      case elongation:
        log.log_elongation = drawn[i];
        break;
      case flatness:
        log.log_flatness = drawn[i];
        break;
      default:
        log.coefficients[std::size_t(index)] = drawn[i];
      }
  }
  for (int n = low_degree + 1; n <= order; ++n)
    for (int m = -n; m <= n; ++m)
      log.coefficients[std::size_t(harmonic_index(n, m))] =
          amplitude * std::sqrt(spectrum[std::size_t(n)] / (2. * n + 1.)) *
          normal_number(random);
  return log;
}

Coefficients ShapeGenerator::operator()(Random &random) const
{
  for (int attempt = 0; attempt < 100; ++attempt)
    if (Coefficients particle = detail::from_log(draw(random));
        !particle.empty())
      return particle;
  throw std::runtime_error("generate: no particle in 100 has a radius above a "
                           "twentieth of its mean: the sample varies too much");
}
} // namespace dem
