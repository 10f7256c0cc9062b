#include "solid_supports.h"

namespace fem
{
SolidSupports::SolidSupports(const SolidMesh &mesh)
    : Followers(mesh.hanging, mesh.nodes.size()),
      fixed(mesh.nodes.size(), {false, false, false}),
      number(mesh.nodes.size(), {-1, -1, -1})
{
  number_unknowns();
}

void SolidSupports::fix(std::span<const std::int32_t> nodes,
                        const std::array<bool, 3> &components)
{
  for (const std::int32_t node : nodes)
  {
    const auto k = static_cast<std::size_t>(node);
    for (std::size_t c = 0; c < 3 && !is_hanging(k); ++c)
      fixed[k][c] = fixed[k][c] || components[c];
  }
  number_unknowns();
}

void SolidSupports::number_unknowns()
{
  n_free = 0;
  for (std::size_t k = 0; k < fixed.size(); ++k)
    for (std::size_t c = 0; c < 3; ++c)
      number[k][c] = fixed[k][c] || is_hanging(k)
                         ? -1
                         : static_cast<std::int32_t>(n_free++);
  ++n_changes;
}

std::vector<SolidSupports::Share> SolidSupports::shares(std::size_t node,
                                                        int component) const
{
  std::vector<Share> result;
  const auto add = [&](std::size_t k, double weight)
  {
    if (unknown(k, component) >= 0)
      result.push_back({unknown(k, component), weight});
  };
  if (!is_hanging(node))
    add(node, 1.);
  else
    for (const auto &[parent, weight] : parents(node))
      add(static_cast<std::size_t>(parent), weight);
  return result;
}
} // namespace fem
