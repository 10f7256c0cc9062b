#pragma once

#include <fem/surface_mesh.h>

#include <string>

namespace fem
{
/// Quads of a gmsh file (.msh as text, formats 1, 2 and 4, order 1), whose
/// sides all face alike where the surface has two. Throws std::invalid_argument
/// with the file, the line and what is wrong: it cannot be opened, is no gmsh
/// file of a surface, or has triangles.
SurfaceMesh read_surface_mesh(const std::string &path);
} // namespace fem
