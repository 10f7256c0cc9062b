#pragma once

#include <dem/vector.h>

#include <array>
#include <cstdint>
#include <vector>

namespace dem
{
/// A triangulated unit sphere with triangles of about one size.
struct Icosphere
{
  std::vector<Vec3> directions;                       ///< unit vectors [-]
  std::vector<std::array<std::int32_t, 3>> triangles; ///< outward
};

/// Icosahedron whose triangles are cut in four n_divisions times:
/// 20 * 4^n_divisions triangles.
Icosphere make_icosphere(int n_divisions);
} // namespace dem
