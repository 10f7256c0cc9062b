#pragma once

#include "ray_hits.h"

namespace dem::detail
{
/// r in some directions, each with its share of the sphere.
struct RadialSamples
{
  std::vector<Vec3> direction; ///< unit vectors [-]
  std::vector<double> radius;  ///< [m]
  std::vector<double> weight;  ///< solid angle, sum 4 pi [sr]
};

/// The outermost hits.
RadialSamples ray_samples(const std::vector<RayHits> &hits,
                          const SphereQuadrature &rule);

/// The points of a mesh around the origin; each has a third of the solid angle
/// of its triangles. Throws std::invalid_argument if a triangle does not face
/// outward (their number).
RadialSamples vertex_samples(const TriangleMesh &mesh);

/// Least squares on the nodes of a rule, under which the harmonics are
/// orthonormal: a_j = sum_k w_k r_k Y_j(s_k) [m].
std::vector<double> project(const RadialSamples &samples, int order);

/// Least squares on any samples by the normal equations [m]. Throws
/// std::invalid_argument with fewer than two samples per coefficient or if
/// they leave coefficients open.
std::vector<double> least_squares(const RadialSamples &samples, int order);
} // namespace dem::detail
