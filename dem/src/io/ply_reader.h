#pragma once

#include <dem/shape/fit.h>

#include <string_view>

namespace dem::detail
{
/// Vertices and faces of a PLY file, text or binary of either byte order;
/// faces of more than three corners are cut into triangles. Throws
/// std::invalid_argument that says what is wrong, without the path.
TriangleMesh read_ply(std::string_view bytes);
} // namespace dem::detail
