#pragma once

#include <Eigen/Core>

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace fem
{
/// A cell with its corners in gmsh's order: round a face, then round the one
/// opposite.
template <std::size_t n>
struct GmshCell
{
  std::array<std::int32_t, n> corners{}; ///< numbers of nodes
  std::int32_t physical = 0;             ///< group, 0 if it has none
};

/// Cells of a file of gmsh; points and lines are left out.
struct GmshMesh
{
  std::vector<Eigen::Vector3d> nodes; ///< [m]
  std::vector<GmshCell<3>> triangles;
  std::vector<GmshCell<4>> quads;
  std::vector<GmshCell<8>> hexahedra;
  std::string other_cell; ///< name of one that is no such; empty: none
};

/// Reads the text of a .msh file of format 1, 2 or 4, linear in its length.
/// Throws std::invalid_argument with the line: no such file, cut off, binary, a
/// node that is missing or given twice, elements of an order above 1.
GmshMesh parse_gmsh(std::string_view text);

/// The same of a file. Throws std::invalid_argument without the path.
GmshMesh read_gmsh(const std::string &path);

/// Throws std::invalid_argument for an edge of more than two quads.
void check_edges(const std::vector<GmshCell<4>> &quads);

/// The quads that lie on the surface of the hexahedra. Throws
/// std::invalid_argument for a face of more than two hexahedra, and for a quad
/// that is a face of none.
std::vector<GmshCell<4>> surface_quads(const GmshMesh &mesh);
} // namespace fem
