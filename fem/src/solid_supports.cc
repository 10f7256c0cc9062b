#include "solid_supports.h"

namespace fem
{
SolidSupports::SolidSupports(const SolidMesh &mesh)
    : hanging(mesh.hanging), hanging_of(mesh.nodes.size(), -1),
      fixed(mesh.nodes.size(), {false, false, false}),
      number(mesh.nodes.size(), {-1, -1, -1})
{
  for (std::size_t k = 0; k < hanging.size(); ++k)
    hanging_of[static_cast<std::size_t>(hanging[k].node)] =
        static_cast<std::int32_t>(k);
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

void SolidSupports::spread(std::span<Eigen::Vector3d> motion) const
{
  for (const SolidMesh::Hanging &follower : hanging)
  {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (const auto &[parent, weight] : follower.parents)
      sum += weight * motion[static_cast<std::size_t>(parent)];
    motion[static_cast<std::size_t>(follower.node)] = sum;
  }
}

void SolidSupports::collect(std::span<Eigen::Vector3d> forces) const
{
  for (const SolidMesh::Hanging &follower : hanging)
  {
    Eigen::Vector3d &force = forces[static_cast<std::size_t>(follower.node)];
    for (const auto &[parent, weight] : follower.parents)
      forces[static_cast<std::size_t>(parent)] += weight * force;
    force.setZero();
  }
}

void SolidSupports::collect(std::span<double> masses) const
{
  for (const SolidMesh::Hanging &follower : hanging)
  {
    double &mass = masses[static_cast<std::size_t>(follower.node)];
    for (const auto &[parent, weight] : follower.parents)
      masses[static_cast<std::size_t>(parent)] += weight * mass;
    mass = 0.;
  }
}

void SolidSupports::collect(std::span<Eigen::Matrix3d> dashpots,
                            std::span<char> is_there) const
{
  for (const SolidMesh::Hanging &follower : hanging)
  {
    const auto k = static_cast<std::size_t>(follower.node);
    if (!is_there[k])
      continue;
    for (const auto &[parent, weight] : follower.parents)
    {
      dashpots[static_cast<std::size_t>(parent)] += weight * dashpots[k];
      is_there[static_cast<std::size_t>(parent)] = 1;
    }
    dashpots[k].setZero();
    is_there[k] = 0;
  }
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
    for (const auto &[parent, weight] :
         hanging[static_cast<std::size_t>(hanging_of[node])].parents)
      add(static_cast<std::size_t>(parent), weight);
  return result;
}
} // namespace fem
