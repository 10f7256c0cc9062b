#include "solid_element.h"

#include <fem/drucker_prager.h>

#include <cmath>
#include <stdexcept>
#include <string>

namespace fem
{
namespace
{
using Vector = Eigen::Vector3d;
using Gradients = std::array<Vector, 8>;
/// Strains xx, yy, zz and twice yz, zx, xy of three amplitudes of one mode.
using Strains = Eigen::Matrix<double, 6, 3>;

double sign(std::size_t corner, int direction)
{
  return (corner >> direction & 1u) != 0 ? 1. : -1.;
}

/// Of the trilinear functions along xi, eta, zeta in [-1, 1].
Gradients unit_gradients(const Vector &at)
{
  Gradients gradients;
  for (std::size_t v = 0; v < 8; ++v)
  {
    const Vector side(sign(v, 0), sign(v, 1), sign(v, 2));
    const Vector factor = 0.5 * (Vector::Ones() + side.cwiseProduct(at));
    gradients[v] = 0.5 * side.cwiseProduct(Vector(factor.y() * factor.z(),
                                                  factor.z() * factor.x(),
                                                  factor.x() * factor.y()));
  }
  return gradients;
}

/// dx / dxi
Eigen::Matrix3d jacobian(const CellCorners &corners, const Gradients &gradients)
{
  Eigen::Matrix3d result = Eigen::Matrix3d::Zero();
  for (std::size_t v = 0; v < 8; ++v)
    result += corners[v] * gradients[v].transpose();
  return result;
}

Strains strains(const Vector &gradient)
{
  const double x = gradient.x(), y = gradient.y(), z = gradient.z();
  Strains b;
  b << x, 0., 0., 0., y, 0., 0., 0., z, 0., z, y, z, 0., x, y, x, 0.;
  return b;
}

VoigtMatrix elasticity(const SolidLayer &layer)
{
  const double nu = layer.poisson_ratio;
  return fem::elasticity(layer.youngs_modulus / (3. * (1. - 2. * nu)),
                         layer.youngs_modulus / (2. * (1. + nu)));
}

std::array<Vector, 8> gauss_points()
{
  std::array<Vector, 8> points;
  for (std::size_t q = 0; q < 8; ++q)
    points[q] = Vector(sign(q, 0), sign(q, 1), sign(q, 2)) / std::sqrt(3.);
  return points;
}

double checked_determinant(const Eigen::Matrix3d &j, const CellCorners &corners)
{
  const double determinant = j.determinant();
  if (!(determinant > 0.))
  {
    const Vector at = corners[0];
    throw std::invalid_argument(
        "solid mesh: the cell with a corner at " + std::to_string(at.x()) +
        ", " + std::to_string(at.y()) + ", " + std::to_string(at.z()) +
        " m is turned inside out or degenerate");
  }
  return determinant;
}
} // namespace

std::array<Vector, 8> point_positions(const CellCorners &corners)
{
  const std::array<Vector, 8> points = gauss_points();
  std::array<Vector, 8> positions;
  for (std::size_t q = 0; q < 8; ++q)
  {
    positions[q] = Vector::Zero();
    for (std::size_t v = 0; v < 8; ++v)
      positions[q] += 0.125 * (1. + sign(v, 0) * points[q].x()) *
                      (1. + sign(v, 1) * points[q].y()) *
                      (1. + sign(v, 2) * points[q].z()) * corners[v];
  }
  return positions;
}

PointGradients point_gradients(const CellCorners &corners)
{
  PointGradients points;
  const std::array<Vector, 8> at = gauss_points();
  for (std::size_t q = 0; q < 8; ++q)
  {
    const Gradients gradients = unit_gradients(at[q]);
    const Eigen::Matrix3d j = jacobian(corners, gradients);
    points.volume[q] = checked_determinant(j, corners);
    for (std::size_t v = 0; v < 8; ++v)
      points.gradient[q].row(static_cast<Eigen::Index>(v)) =
          j.inverse().transpose() * gradients[v];
  }
  return points;
}

CellPoints mean_dilatation_points(const CellCorners &corners)
{
  const PointGradients gradients = point_gradients(corners);
  CellPoints points;
  points.volume = gradients.volume;
  Eigen::Matrix<double, 1, 24> mean = Eigen::Matrix<double, 1, 24>::Zero();
  double volume = 0.;
  for (std::size_t q = 0; q < 8; ++q)
  {
    for (Eigen::Index v = 0; v < 8; ++v)
      points.strain[q].middleCols<3>(3 * v) =
          strains(gradients.gradient[q].row(v));
    mean += points.volume[q] * points.strain[q].topRows<3>().colwise().sum();
    volume += points.volume[q];
  }
  mean /= volume;
  for (auto &b : points.strain)
  {
    const Eigen::Matrix<double, 1, 24> change =
        (mean - b.topRows<3>().colwise().sum()) / 3.;
    b.topRows<3>().rowwise() += change;
  }
  return points;
}

namespace
{
CellMatrix mean_dilatation_stiffness(const CellCorners &corners,
                                     const SolidLayer &layer)
{
  const CellPoints points = mean_dilatation_points(corners);
  CellMatrix sum = CellMatrix::Zero();
  for (std::size_t q = 0; q < 8; ++q)
    sum += points.volume[q] * points.strain[q].transpose() * elasticity(layer) *
           points.strain[q];
  return 0.5 * (sum + sum.transpose());
}
} // namespace

CellMatrix cell_stiffness(const CellCorners &corners, const SolidLayer &layer)
{
  if (!layer.is_linear())
    return mean_dilatation_stiffness(corners, layer);
  const VoigtMatrix c = elasticity(layer);
  const Eigen::Matrix3d centre =
      jacobian(corners, unit_gradients(Vector::Zero()));
  const double centre_volume = checked_determinant(centre, corners);
  const Eigen::Matrix3d centre_slope = centre.inverse().transpose();

  CellMatrix nodal = CellMatrix::Zero();
  Eigen::Matrix<double, 24, 9> mixed = Eigen::Matrix<double, 24, 9>::Zero();
  Eigen::Matrix<double, 9, 9> inner = Eigen::Matrix<double, 9, 9>::Zero();
  for (const Vector &at : gauss_points())
  {
    const Gradients gradients = unit_gradients(at);
    const Eigen::Matrix3d j = jacobian(corners, gradients);
    const double volume = checked_determinant(j, corners);
    const Eigen::Matrix3d slope = j.inverse().transpose();
    Eigen::Matrix<double, 6, 24> b;
    for (std::size_t v = 0; v < 8; ++v)
      b.middleCols<3>(3 * static_cast<Eigen::Index>(v)) =
          strains(slope * gradients[v]);
    Eigen::Matrix<double, 6, 9> modes;
    for (Eigen::Index m = 0; m < 3; ++m)
      modes.middleCols<3>(3 * m) = strains(centre_slope.col(m) * (-2. * at(m)) *
                                           (centre_volume / volume));
    nodal += volume * b.transpose() * c * b;
    mixed += volume * b.transpose() * c * modes;
    inner += volume * modes.transpose() * c * modes;
  }
  nodal -= mixed * inner.ldlt().solve(mixed.transpose());
  return 0.5 * (nodal + nodal.transpose());
}

std::array<double, 8> cell_mass(const CellCorners &corners, double density)
{
  std::array<double, 8> mass{};
  for (const Vector &at : gauss_points())
  {
    const double volume =
        checked_determinant(jacobian(corners, unit_gradients(at)), corners);
    for (std::size_t v = 0; v < 8; ++v)
      mass[v] += density * volume * 0.125 * (1. + sign(v, 0) * at.x()) *
                 (1. + sign(v, 1) * at.y()) * (1. + sign(v, 2) * at.z());
  }
  return mass;
}

Voigt centre_stress(const CellCorners &corners, const SolidLayer &layer,
                    const std::array<Vector, 8> &displacement)
{
  const Gradients gradients = unit_gradients(Vector::Zero());
  const Eigen::Matrix3d slope =
      jacobian(corners, gradients).inverse().transpose();
  Voigt strain = Voigt::Zero();
  for (std::size_t v = 0; v < 8; ++v)
    strain += strains(slope * gradients[v]) * displacement[v];
  return elasticity(layer) * strain;
}
} // namespace fem
