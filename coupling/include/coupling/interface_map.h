#pragma once

#include <dem/boundary/facet_surface.h>
#include <dem/integrate/stable_step.h>
#include <fem/membrane.h>

namespace coupling
{
/// Joins the quads of a membrane to the triangles of a facet surface: each
/// quad becomes four triangles round its centre. With T the map from nodes to
/// vertices (rows sum to one: a node to itself, a quarter of each of four nodes
/// to a centre), motion goes out as x_s = T x and loads come back as
/// f = T^t f_s, so force, moment and power are equal on both sides.
class InterfaceMap
{
public:
  explicit InterfaceMap(const fem::Membrane &membrane);

  /// The surface with its topology, positions, velocities and masses set.
  dem::FacetSurface make_surface(const fem::Membrane &membrane) const;

  /// Positions and velocities of the vertices from the nodes.
  void send_motion(const fem::Membrane &membrane,
                   dem::FacetSurface &surface) const;

  /// Nodal loads from the loads on the vertices [N]; overwrites.
  void collect_load(const dem::FacetSurface &surface,
                    std::vector<Eigen::Vector3d> &nodal_load) const;

  /// Springs whose points are the vertices get the nodes instead: a centre is
  /// a quarter of each corner; tied nodes are walls.
  void refer_to_nodes(const fem::Membrane &membrane,
                      dem::SpringNetwork &springs) const;

private:
  std::size_t n_nodes;
  std::vector<std::array<std::int32_t, 4>> quads;
};

/// Sums over both sides of the interface at one instant.
struct InterfaceBalance
{
  double force_error = 0.;  ///< |sum f - sum f_s| / sum |f_s| [-]
  double moment_error = 0.; ///< about the origin, / sum |x| |f_s| [-]
  double power_error = 0.;  ///< / sum |v| |f_s| [-]
};

InterfaceBalance check_balance(const dem::FacetSurface &surface,
                               const fem::Membrane &membrane,
                               std::span<const Eigen::Vector3d> nodal_load);
} // namespace coupling
