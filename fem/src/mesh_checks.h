#pragma once

#include <fem/surface_mesh.h>

namespace fem
{
/// Throws std::invalid_argument with one line unless the mesh is a surface as
/// SurfaceMesh says: numbers in range, every node used,
/// none in the middle of an edge, quads of positive area
/// without re-entrant corners, neighbours numbered the same way round, no edge
/// with more than two quads.
void check_mesh(const SurfaceMesh &mesh);
} // namespace fem
