#pragma once

#include <fem/hanging_node.h>

#include <Eigen/Dense>

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace fem
{
/// A body of eight-node cells. Corner v of a cell is the one at (v & 1,
/// v >> 1 & 1, v >> 2 & 1) of its unit cube.
struct SolidMesh
{
  /// A quad of the surface, counter-clockwise seen from outside.
  struct Face
  {
    std::array<std::int32_t, 4> corners{};
    std::int32_t boundary = 0; ///< which part of the surface
    std::int32_t cell = 0;     ///< the cell behind it
  };

  std::vector<Eigen::Vector3d> nodes; ///< [m]
  std::vector<std::array<std::int32_t, 8>> cells;
  std::vector<std::int32_t> layer; ///< material of each cell
  std::vector<HangingNode> hanging;
  std::vector<Face> faces;
};

/// Parts of the surface of box_mesh and quarter_cylinder_mesh.
enum BoxSide : std::int32_t
{
  x_lower = 0,
  x_upper = 1,
  y_lower = 2,
  y_upper = 3,
  z_lower = 4,
  z_upper = 5
};

/// Cells whose centre lies in here are halved until they have been so `level`
/// times.
struct RefinedRegion
{
  Eigen::Vector3d lower, upper; ///< [m]
  int level = 1;
};

struct BoxMesh
{
  Eigen::Vector3d lower = Eigen::Vector3d::Zero(); ///< [m]
  std::array<std::vector<double>, 3> widths; ///< of the cells along x, y, z [m]
  std::vector<RefinedRegion> refined;        ///< library only: no case has any
};

/// Sides are numbered as BoxSide. Throws std::invalid_argument on widths that
/// are not positive.
SolidMesh box_mesh(const BoxMesh &box);

/// A quarter x, y > 0 of a round block below z = 0 with a circle at `radius`
/// among its mesh lines: square cells inside, rings around.
struct QuarterCylinder
{
  double radius = 1.;          ///< of the inner circle [m]
  int n_square = 4;            ///< cells along a side of the inner square
  std::vector<double> inner;   ///< ring widths from the square to the circle
                               ///< along the diagonal, as shares of their sum
  std::vector<double> outer;   ///< ring widths from the circle outward [m]
  std::vector<double> heights; ///< cell heights from the top down [m]
};

/// Sides: x_lower and y_lower the planes of symmetry, x_upper the round side.
SolidMesh quarter_cylinder_mesh(const QuarterCylinder &block);

/// Hexahedra of a gmsh file (.msh as text, formats 1, 2 and 4, order 1):
/// physical volumes are the layers, physical surfaces the boundaries. Throws
/// std::invalid_argument with the file, the line and what is wrong: it cannot
/// be read, has other cells, or cells that are turned inside out.
SolidMesh read_solid_mesh(const std::string &path);

/// Layer k of a cell is the first whose top lies above its centre; the last
/// layer takes what is above all. Tops ascend [m].
void assign_layers(SolidMesh &mesh, std::span<const double> tops);

/// Widths that grow by `growth` from `first` until they fill `length`, then
/// scaled to fill it exactly [m].
std::vector<double> graded_widths(double first, double growth, double length);
} // namespace fem
