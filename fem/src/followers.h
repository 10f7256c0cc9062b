#pragma once

#include <fem/hanging_node.h>

#include <Eigen/Dense>

#include <span>

namespace fem
{
/// The hanging nodes of a mesh: they move with their parents and hand over to
/// them what acts on them. No parent hangs itself.
class Followers
{
public:
  Followers(std::vector<HangingNode> of_mesh, std::size_t n_nodes);

  bool is_hanging(std::size_t node) const { return index_of[node] >= 0; }
  /// Of a node that hangs.
  std::span<const std::pair<std::int32_t, double>>
  parents(std::size_t node) const
  {
    return hanging[static_cast<std::size_t>(index_of[node])].parents;
  }

  /// Motion of the hanging nodes from that of their parents.
  void spread(std::span<Eigen::Vector3d> motion) const;
  /// Forces, or masses, of the hanging nodes to their parents.
  void collect(std::span<Eigen::Vector3d> forces) const;
  void collect(std::span<double> masses) const;
  /// Dashpots too; `is_there` is set for the nodes that get a share.
  void collect(std::span<Eigen::Matrix3d> dashpots,
               std::span<char> is_there) const;

private:
  std::vector<HangingNode> hanging;
  std::vector<std::int32_t> index_of; ///< of a node in `hanging` or -1
};
} // namespace fem
