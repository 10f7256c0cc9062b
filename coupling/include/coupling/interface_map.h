#pragma once

#include <dem/boundary/facet_surface.h>
#include <dem/integrate/stable_step.h>
#include <fem/surface_mesh.h>

namespace coupling
{
/// Columns over the nodes of a body's surface.
using Field = std::vector<Eigen::Vector3d>;
using FieldView = std::span<const Eigen::Vector3d>;

struct NodeMotion
{
  FieldView position; ///< [m]
  FieldView velocity; ///< [m/s]
};

/// Side of the quads on which the particles are.
enum class ParticleSide
{
  inside, ///< a membrane round them: normals point away from the particles
  outside ///< a body that they lie on: normals point to the particles
};

/// Joins the quads of a body to the triangles of a facet surface: each
/// quad becomes four triangles round its centre, five or more where midpoints
/// halve its edges, so that the facets meet edge to edge. With T the map from
/// nodes to vertices (rows sum to one: a node to itself, half of each end to a
/// midpoint, a quarter of each corner to a centre), motion goes out as x_s = T
/// x and loads come back as f = T^t f_s, so force, moment and power are equal
/// on both sides. No load comes to a midpoint.
class InterfaceMap
{
public:
  explicit InterfaceMap(const fem::SurfaceMesh &mesh,
                        ParticleSide side = ParticleSide::inside);

  /// The surface with its topology, positions, velocities and masses set;
  /// `nodal_mass` is infinite where nodes are prescribed [kg].
  dem::FacetSurface make_surface(const NodeMotion &motion,
                                 std::span<const double> nodal_mass) const;

  /// Positions and velocities of the vertices from the nodes.
  void send_motion(const NodeMotion &motion, dem::FacetSurface &surface) const;

  /// What acts on the nodes from what acts on the vertices, loads or impulses;
  /// overwrites.
  void collect(FieldView on_vertices, std::span<Eigen::Vector3d> nodal) const;

  /// The nodes that a vertex moves with, up to four; unused shares are -1.
  std::array<dem::FarShare, 4> shares(std::size_t vertex) const;

  std::size_t n_nodes() const { return nodes; }
  std::size_t n_vertices() const { return nodes + quads.size(); }

private:
  std::vector<std::array<std::int32_t, 3>> triangles() const;

  std::size_t nodes;
  std::vector<std::array<std::int32_t, 4>> quads;
  std::vector<fem::SurfaceMesh::Midpoint> midpoints;
  std::vector<std::array<std::int32_t, 2>> ends; ///< of nodes; -1: moves freely
  ParticleSide particles;
};

/// The nodes behind one facet surface of the engine.
struct SurfacePoints
{
  const InterfaceMap *map = nullptr;
  std::vector<double> nodal_mass; ///< infinite: prescribed [kg]
};

/// Springs whose points are the vertices of these surfaces, one after the
/// other, get the nodes instead: a centre is a quarter of each corner;
/// prescribed nodes are walls.
void refer_to_nodes(std::span<const SurfacePoints> surfaces,
                    dem::SpringNetwork &springs);

/// Sums over both sides at one instant; library only, runs keep the ledger.
struct InterfaceBalance
{
  double force_error = 0.;  ///< |sum f - sum f_s| / sum |f_s| [-]
  double moment_error = 0.; ///< about the origin, / sum |x| |f_s| [-]
  double power_error = 0.;  ///< / sum |v| |f_s| [-]
};

InterfaceBalance check_balance(const dem::FacetSurface &surface,
                               const NodeMotion &motion, FieldView nodal_load);
} // namespace coupling
