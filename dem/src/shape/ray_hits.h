#pragma once

#include <dem/shape/fit.h>
#include <dem/shape/quadrature.h>

namespace dem::detail
{
/// What the ray from the origin through one node meets.
struct RayHits
{
  int n_hits = 0;
  int winding = 0;         ///< hits from inside minus hits from outside
  double outermost = 0.;   ///< largest distance [m]
  double signed_cube = 0.; ///< sum of distance^3 with the sign of the hit
};

/// Rays from the origin through the nodes of the rule. Both triangles of an
/// edge decide about a ray by the same number, so that no ray slips through;
/// a ray whose winding still differs from the others (it meets a corner to
/// round-off) is moved by 1e-9 rad.
std::vector<RayHits> cast_rays(const TriangleMesh &mesh,
                               const SphereQuadrature &rule);
} // namespace dem::detail
