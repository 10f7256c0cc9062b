#include "node_owners.h"

#include <deal.II/lac/dynamic_sparsity_pattern.h>
#include <deal.II/lac/sparsity_pattern.h>
#include <deal.II/lac/sparsity_tools.h>

namespace fem
{
std::vector<int> divide_nodes(const SolidMesh &mesh, int n_parts)
{
  const std::size_t n = mesh.nodes.size();
  if (n_parts == 1)
    return std::vector<int>(n, 0);
  dealii::DynamicSparsityPattern neighbours(n, n);
  const auto join = [&](std::int32_t a, std::int32_t b)
  {
    neighbours.add(static_cast<std::size_t>(a), static_cast<std::size_t>(b));
    neighbours.add(static_cast<std::size_t>(b), static_cast<std::size_t>(a));
  };
  for (const auto &cell : mesh.cells)
    for (const std::int32_t node : cell)
      for (const std::int32_t other : cell)
        join(node, other);
  for (const HangingNode &hanging : mesh.hanging)
    for (const auto &[parent, weight] : hanging.parents)
      join(hanging.node, parent);
  dealii::SparsityPattern pattern;
  pattern.copy_from(neighbours);
  std::vector<unsigned int> part(n, 0);
  dealii::SparsityTools::partition(pattern, static_cast<unsigned int>(n_parts),
                                   part);
  return {part.begin(), part.end()};
}
} // namespace fem
