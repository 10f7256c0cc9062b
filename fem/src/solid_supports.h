#pragma once

#include "followers.h"

#include <fem/solid_mesh.h>

namespace fem
{
/// Which components of which nodes move freely, and how the hanging nodes
/// follow the others.
class SolidSupports : public Followers
{
public:
  explicit SolidSupports(const SolidMesh &mesh);

  /// Hanging nodes are passed over: they follow their parents.
  void fix(std::span<const std::int32_t> nodes,
           const std::array<bool, 3> &components);
  bool is_fixed(std::size_t node, int component) const
  {
    return fixed[node][static_cast<std::size_t>(component)];
  }

  /// A component of a node as a sum of unknowns; empty if it is fixed.
  struct Share
  {
    std::int32_t unknown = 0;
    double weight = 1.;
  };
  std::vector<Share> shares(std::size_t node, int component) const;
  std::size_t n_unknowns() const { return n_free; }
  /// The unknown of a component, -1 if it is fixed or hanging.
  std::int32_t unknown(std::size_t node, int component) const
  {
    return number[node][static_cast<std::size_t>(component)];
  }
  int version() const { return n_changes; } ///< grows with every change

private:
  void number_unknowns();

  std::vector<std::array<bool, 3>> fixed;
  std::vector<std::array<std::int32_t, 3>> number;
  std::size_t n_free = 0;
  int n_changes = 0;
};
} // namespace fem
