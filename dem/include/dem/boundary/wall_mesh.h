#pragma once

#include <dem/boundary/facet_surface.h>
#include <dem/shape/fit.h>

namespace dem
{
/// Where the particles are.
enum class WallSide
{
  outside, ///< of a closed mesh; of an open one where its normals point
  inside   ///< of a closed mesh; behind an open one
};

/// The surface of a rigid wall from a mesh, closed or open, of any number of
/// pieces [m]. Points that are equal are one, and where edges stay open also
/// those within a millionth of the diagonal of the mesh. Triangles that run
/// against their neighbours are turned: a closed piece outward, an open one the
/// way of most of its triangles. Throws std::invalid_argument with one clear
/// line on a mesh without triangles, edges of more than two triangles (their
/// number), a surface with one side alone, and as FacetTopology.
FacetSurface wall_surface(const TriangleMesh &mesh, WallSide side);
} // namespace dem
