#pragma once

#include <dem/shape/fit.h>

#include <string>
#include <string_view>

namespace dem
{
enum class MeshFormat
{
  stl, ///< text or binary
  ply, ///< text or binary of either byte order
  obj
};

/// The triangles of a file with these bytes [file's own unit]. Throws
/// std::invalid_argument with one clear line: what is wrong and where.
TriangleMesh parse_mesh(std::string_view bytes, MeshFormat format);

/// The same of an STL, PLY or OBJ file by its ending; the line begins with the
/// path. Throws for a missing or unreadable file and another ending, too.
TriangleMesh read_mesh(const std::string &path);
} // namespace dem
