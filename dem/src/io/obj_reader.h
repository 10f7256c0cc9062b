#pragma once

#include <dem/shape/fit.h>

#include <string_view>

namespace dem::detail
{
/// Vertices and faces of an OBJ file; what else it has is skipped. Faces of
/// more than three corners are cut into triangles. Throws
/// std::invalid_argument with the line.
TriangleMesh read_obj(std::string_view text);
} // namespace dem::detail
