#pragma once

#include <Eigen/Dense>

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace fem
{
/// A surface of four-node facets in space. Every quad is numbered round its
/// rim, counter-clockwise seen from outside.
struct SurfaceMesh
{
  /// A node in the middle of an edge of a larger quad, where two smaller ones
  /// meet it: it moves with the ends of that edge, as their mean.
  struct Midpoint
  {
    std::int32_t node = 0;
    std::array<std::int32_t, 2> ends{};
  };

  std::vector<Eigen::Vector3d> nodes;             ///< reference position [m]
  std::vector<std::array<std::int32_t, 4>> quads; ///< node numbers, rim order
  std::vector<Midpoint> midpoints =
      {}; ///< none where all quads meet edge to edge
};

/// The four vertical sides of the box as one closed tube, n[0], n[1], n[2]
/// quads along x, y, z. Throws std::invalid_argument on an empty box or n < 1.
SurfaceMesh box_sides(const Eigen::Vector3d &lower,
                      const Eigen::Vector3d &upper,
                      const std::array<int, 3> &n);

/// The side of an upright cylinder on the z axis, from z = 0 to height [m].
SurfaceMesh cylinder_side(double radius, double height, int n_around,
                          int n_along);

/// The mesh with these quads halved along both directions: the same surface,
/// with midpoints where a smaller quad meets one that is left. Throws
/// std::invalid_argument on a number that is no quad, or a mesh that has
/// midpoints already.
SurfaceMesh halve_quads(const SurfaceMesh &mesh,
                        std::span<const std::int32_t> quads);

/// Nodes with |z - height| < tolerance.
std::vector<std::int32_t> nodes_at_height(const SurfaceMesh &mesh,
                                          double height, double tolerance);
} // namespace fem
