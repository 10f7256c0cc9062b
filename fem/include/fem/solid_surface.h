#pragma once

#include <fem/solid.h>
#include <fem/surface_mesh.h>

#include <functional>

namespace fem
{
/// A part of the surface of a body as a mesh of its own, for what touches it:
/// node k of the surface is node[k] of the body. Hanging nodes come last and
/// are its midpoints.
struct SolidSurface
{
  SurfaceMesh mesh;
  std::vector<std::int32_t> node;
  /// Nodes that move by themselves: all but the midpoints.
  std::size_t n_free() const { return node.size() - mesh.midpoints.size(); }
};

/// Throws std::invalid_argument if the body has no such boundary, or a hanging
/// node on it halves no edge of it.
SolidSurface boundary_surface(const SolidMesh &mesh, std::int32_t boundary);

/// Nodes of a part of the surface, each once, ascending.
std::vector<std::int32_t> boundary_nodes(const SolidMesh &mesh,
                                         std::int32_t boundary);

/// Positions of the surface in the moved body [m], and its velocities [m/s].
void send_motion(const Solid &solid, const SolidSurface &surface,
                 std::span<Eigen::Vector3d> positions,
                 std::span<Eigen::Vector3d> velocities);
/// Adds loads on the nodes of the surface to those of the body [N].
void add_loads(const SolidSurface &surface,
               std::span<const Eigen::Vector3d> loads,
               std::span<Eigen::Vector3d> body_loads);

/// A traction at a point of the surface, in the undeformed body [Pa].
using Traction = std::function<Eigen::Vector3d(const Eigen::Vector3d &)>;

/// Nodal loads int N_v t dA over a boundary [N], each face in n_parts x
/// n_parts parts with 2 x 2 Gauss points: several where the traction jumps.
std::vector<Eigen::Vector3d> traction_loads(const SolidMesh &mesh,
                                            std::int32_t boundary,
                                            const Traction &traction,
                                            int n_parts = 1);
} // namespace fem
