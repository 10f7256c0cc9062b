#pragma once

#include <dem/shape/quadrature.h>

#include <span>

namespace dem
{
/// Integrals over the body bounded by x = r(s) s.
struct ShapeMeasures
{
  double volume = 0.;               ///< V = 1/3 int r^3 [m^3]
  double area = 0.;                 ///< S = int r sqrt(r^2 + |grad r|^2) [m^2]
  Vec3 centroid = Vec3::Zero();     ///< from the origin of the series [m]
  Mat3 inertia = Mat3::Zero();      ///< about the centroid, unit density [m^5]
  double inscribed_radius = 0.;     ///< min of r over the nodes [m]
  double circumscribed_radius = 0.; ///< max of r over the nodes [m]
  double mean_radius = 0.;          ///< a_00 / sqrt(4 pi) [m]
  double max_slope = 0.;            ///< max of |grad_S r| over the nodes [m]
  double max_curvature = 0.;        ///< max of kappa_max over the nodes [1/m]
  double sphericity = 0.;           ///< Wadell: (36 pi V^2)^(1/3) / S [-]
  double saddle_fraction = 0.;      ///< share of directions, kappa_min < 0 [-]
  double corner_fraction = 0.;      ///< share of the area with g = 1 [-]
  double roundness = 1.;            ///< R_g of Eq. 30, area weights [-]
};

ShapeMeasures measure_shape(std::span<const double> coefficients,
                            const SphereQuadrature &rule);

/// Volume from node radii: exact for 3 order <= 2 n_polar - 1 [m^3].
double volume(std::span<const double> radii, const SphereQuadrature &rule);

/// Eq. 14: a corner or edge has kappa_max r_ins > 1 + 1e-3.
bool is_corner(double max_curvature, double inscribed_radius);

/// R_g of Eq. 30 alone (the costly part of measure_shape) [-].
double roundness(std::span<const double> coefficients,
                 const SphereQuadrature &rule);
} // namespace dem
