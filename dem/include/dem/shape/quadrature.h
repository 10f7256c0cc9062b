#pragma once

#include <dem/vector.h>

#include <span>
#include <vector>

namespace dem
{
/// Product rule on the unit sphere: Gauss-Legendre in cos(theta), uniform in
/// phi. Exact for spherical polynomials of degree 2 n_polar - 1 if
/// n_azimuth >= 2 n_polar. Node k = i_polar * n_azimuth + i_azimuth.
struct SphereQuadrature
{
  int n_polar = 0;                    ///< rings [-]
  int n_azimuth = 0;                  ///< nodes per ring [-]
  std::vector<Vec3> direction;        ///< unit vectors [-]
  std::vector<double> weight;         ///< solid angle, sum 4 pi [sr]
  std::vector<double> ring_cosine;    ///< cos(theta) of each ring [-]
  std::vector<double> azimuth_cosine; ///< cos(m phi_k), row m of n_azimuth [-]
  std::vector<double> azimuth_sine;   ///< sin(m phi_k), m = 0 .. max_order [-]
};

/// Throws std::invalid_argument unless both numbers are positive.
SphereQuadrature make_quadrature(int n_polar, int n_azimuth);

/// The rule of n x 2n nodes; each is made once and lives for ever. Throws
/// std::invalid_argument unless n is positive.
const SphereQuadrature &sphere_rule(int n);

/// The 40 x 80 rule of the model.
const SphereQuadrature &standard_quadrature();

/// r at every node of the rule [m], ring by ring (cost ~ n_polar * order *
/// (order + 2 n_azimuth)).
std::vector<double> node_radii(std::span<const double> coefficients,
                               const SphereQuadrature &rule);
} // namespace dem
