#pragma once

#include <dem/exact_sum.h>
#include <dem/parallel/ranks.h>

#include <Eigen/Dense>

#include <cstddef>
#include <vector>

namespace coupling
{
/// How the loads of contacts on each node change with its motion, what its
/// neighbours do left out. Sums over contacts that do not depend on their
/// order, nor on the ranks that have them.
class ContactTangent
{
public:
  /// Nothing on so many nodes.
  void clear(std::size_t n_nodes);
  /// Adds a spring [N/m] and a dashpot [N s/m] on a node, both symmetric.
  void add(std::size_t node, const Eigen::Matrix3d &spring,
           const Eigen::Matrix3d &dashpot);
  /// Makes `springs` and `dashpots` of what all ranks have added. Collective.
  void finish(const dem::Ranks &ranks);

  std::vector<Eigen::Matrix3d> springs;  ///< by node [N/m]
  std::vector<Eigen::Matrix3d> dashpots; ///< by node [N s/m]

private:
  std::vector<dem::ExactSum> sums; ///< of one triangle of each, by node
};
} // namespace coupling
