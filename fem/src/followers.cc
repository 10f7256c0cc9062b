#include "followers.h"

#include <utility>

namespace fem
{
namespace
{
/// What the nodes hold to their parents; nothing is left.
template <typename Value>
void hand_over(const std::vector<HangingNode> &hanging, std::span<Value> values,
               const Value &nothing)
{
  for (const HangingNode &follower : hanging)
  {
    Value &value = values[static_cast<std::size_t>(follower.node)];
    for (const auto &[parent, weight] : follower.parents)
      values[static_cast<std::size_t>(parent)] += weight * value;
    value = nothing;
  }
}
} // namespace

Followers::Followers(std::vector<HangingNode> of_mesh, std::size_t n_nodes)
    : hanging(std::move(of_mesh)), index_of(n_nodes, -1)
{
  for (std::size_t k = 0; k < hanging.size(); ++k)
    index_of[static_cast<std::size_t>(hanging[k].node)] =
        static_cast<std::int32_t>(k);
}

void Followers::spread(std::span<Eigen::Vector3d> motion) const
{
  for (const HangingNode &follower : hanging)
  {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (const auto &[parent, weight] : follower.parents)
      sum += weight * motion[static_cast<std::size_t>(parent)];
    motion[static_cast<std::size_t>(follower.node)] = sum;
  }
}

void Followers::collect(std::span<Eigen::Vector3d> forces) const
{
  hand_over<Eigen::Vector3d>(hanging, forces, Eigen::Vector3d::Zero());
}

void Followers::collect(std::span<double> masses) const
{
  hand_over(hanging, masses, 0.);
}

void Followers::collect(std::span<Eigen::Matrix3d> dashpots,
                        std::span<char> is_there) const
{
  for (const HangingNode &follower : hanging)
    if (char &is_here = is_there[static_cast<std::size_t>(follower.node)])
    {
      for (const auto &[parent, weight] : follower.parents)
        is_there[static_cast<std::size_t>(parent)] = 1;
      is_here = 0;
    }
  hand_over<Eigen::Matrix3d>(hanging, dashpots, Eigen::Matrix3d::Zero());
}
} // namespace fem
