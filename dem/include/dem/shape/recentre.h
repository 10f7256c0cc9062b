#pragma once

#include <dem/vector.h>

#include <span>
#include <vector>

namespace dem
{
/// A series with its origin at the centroid of the volume.
struct Recentred
{
  std::vector<double> coefficients; ///< of the order of the old series [m]
  Vec3 shift = Vec3::Zero();        ///< of the origin, in the old frame [m]
  /// Largest distance along a ray between the new surface and the old one, over
  /// the mean radius [-].
  double deviation = 0.;
};

/// Centroid of the volume from the origin of the series, over the mean radius
/// [-].
Vec3 relative_centroid(std::span<const double> coefficients);

/// Expands the surface again about its centroid: r of the old surface along
/// rays through the nodes of the standard rule, projected as a fit of a mesh
/// does. Repeats until the centroid of the new series is within 1e-6 of the
/// mean radius. Throws std::invalid_argument where a ray from the centroid
/// leaves the surface more than once or the series would have no radius.
Recentred recentre(std::span<const double> coefficients);
} // namespace dem
