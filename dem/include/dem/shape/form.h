#pragma once

#include <dem/shape/quadrature.h>

#include <span>

namespace dem
{
/// Feret diameters, each of the whole surface. Length: the largest distance
/// of two points; width: the largest caliper across the length; thickness: the
/// caliper across both.
struct Calipers
{
  double length = 0.;    ///< L [m]
  double width = 0.;     ///< I or W [m]
  double thickness = 0.; ///< S or T [m]
};

/// Over 80 x 160 nodes: tips are missed by up to 0.3 % of r.
Calipers calipers(std::span<const double> coefficients);

/// Volume over that of the convex hull, both of the polyhedron of 60 x 120
/// nodes: 1 for a convex shape, whose nodes all are corners of the hull [-].
double convexity(std::span<const double> coefficients);

struct InscribedSphere
{
  Vec3 centre = Vec3::Zero(); ///< from the origin of the series [m]
  double radius = 0.;         ///< [m]
};

/// The largest sphere inside, centre free, over 120 x 240 nodes (1e-3 of r):
/// the highest top of the distance to the surface that is reached from the
/// origin uphill.
InscribedSphere inscribed_sphere(std::span<const double> coefficients);

/// The same over the nodes of a rule.
InscribedSphere inscribed_sphere(std::span<const double> coefficients,
                                 const SphereQuadrature &rule);
} // namespace dem
