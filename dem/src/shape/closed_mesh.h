#pragma once

#include <dem/shape/fit.h>

namespace dem::detail
{
/// A welded mesh whose every edge has exactly two triangles, all bodies
/// turned outward. A mesh that is open with equal points merged is welded
/// again within a millionth of the diagonal of its box.
struct ClosedMesh
{
  TriangleMesh mesh;
  int n_bodies = 0;             ///< connected by edges [-]
  double volume = 0.;           ///< [m^3]
  double area = 0.;             ///< [m^2]
  Vec3 centroid = Vec3::Zero(); ///< of the volume [m]
  /// Points that were not equal but nearer than this are one [m]; 0: none.
  double weld_distance = 0.;
  std::int32_t n_welded = 0; ///< points that became another one so [-]
};

/// Throws std::invalid_argument with one line: no triangles, a point that is
/// not finite, a triangle without its points, open or shared edges (their
/// number), no orientation, no volume.
ClosedMesh close_mesh(const TriangleMesh &mesh);
} // namespace dem::detail
