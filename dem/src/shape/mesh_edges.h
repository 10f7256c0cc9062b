#pragma once

#include <dem/shape/fit.h>

#include <cstddef>
#include <vector>

namespace dem::detail
{
/// The triangle at the other side of an edge.
struct MeshLink
{
  std::int32_t other = 0;
  bool is_against = false; ///< both run along the edge the same way
};

/// How the triangles of a mesh meet.
struct MeshEdges
{
  /// Of each triangle, over edges of exactly two, in no particular order.
  std::vector<std::vector<MeshLink>> links;
  std::size_t n_open = 0;   ///< edges of one triangle
  std::size_t n_shared = 0; ///< edges of more than two
};

MeshEdges find_edges(const std::vector<std::array<std::int32_t, 3>> &triangles);

/// Triangles that are connected by edges.
struct MeshBody
{
  std::vector<std::size_t> triangles;
  std::size_t n_turned = 0; ///< of them
};

/// Turns triangles until all of a body run the way of its first one. Throws
/// std::invalid_argument on a surface with one side, as a Moebius strip.
std::vector<MeshBody> turn_one_way(TriangleMesh &mesh, const MeshEdges &edges);

/// Turns all triangles of a body.
void turn_over(TriangleMesh &mesh, const MeshBody &body);

/// Six times the volume between a triangle and the origin [m^3].
double six_volume(const TriangleMesh &mesh,
                  const std::array<std::int32_t, 3> &triangle);

/// Throws std::invalid_argument on a mesh without triangles, a point that is
/// not finite, or a triangle that names a point that is not there.
void require_sound(const TriangleMesh &mesh);

/// Points that are nearer than this share of the diagonal of the box round a
/// mesh are one point where it is open without [-].
inline constexpr double weld_share = 1e-6;

/// Diagonal of the box round a mesh that has points [m].
double diagonal(const TriangleMesh &mesh);
} // namespace dem::detail
