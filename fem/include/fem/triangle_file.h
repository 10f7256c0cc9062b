#pragma once

#include <Eigen/Core>

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace fem
{
/// Triangles in space.
struct Triangles
{
  std::vector<Eigen::Vector3d> nodes;
  std::vector<std::array<std::int32_t, 3>> corners; ///< numbers of nodes
};

/// The triangles and quads of a gmsh file (.msh as text, formats 1, 2 and 4,
/// order 1) [unit of the file]; quads are cut along their shorter diagonal.
/// Throws std::invalid_argument with the file, the line and what is wrong: it
/// cannot be opened, is no gmsh file, or has no such cells.
Triangles read_triangles(const std::string &path);
} // namespace fem
