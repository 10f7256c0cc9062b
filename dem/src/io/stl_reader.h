#pragma once

#include <dem/shape/fit.h>

#include <string_view>

namespace dem::detail
{
/// Triangles of an STL file, as text or binary; each has points of its own.
/// Throws std::invalid_argument with the line of a text, and where a binary
/// file has more or fewer triangles than its header says.
TriangleMesh read_stl(std::string_view bytes);
} // namespace dem::detail
