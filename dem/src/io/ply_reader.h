#pragma once

#include <dem/shape/fit.h>

#include <string>

namespace dem::detail
{
/// Reads the vertices and faces of a PLY file, text or binary of either byte
/// order; polygons are cut into fans. Our own, as the reader of VTK 9.1 breaks
/// down on a file that was cut short. Throws std::invalid_argument that says
/// what is wrong, without the path.
TriangleMesh read_ply(const std::string &path);
} // namespace dem::detail
