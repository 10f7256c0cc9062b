#pragma once

#include <dem/shape/fit.h>

#include <string>

namespace dem
{
/// Reads an STL, PLY or OBJ file, STL and OBJ through VTK [file's own unit].
/// Throws std::invalid_argument with one clear line: missing file, unknown
/// ending, no triangles, unreadable.
TriangleMesh read_mesh(const std::string &path);
} // namespace dem
