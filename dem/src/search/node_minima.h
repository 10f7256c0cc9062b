#pragma once

#include <dem/shape/radius_map.h>

namespace dem
{
/// Whether no node of a map beside this one has a smaller gap; of equal ones
/// the first counts. `gap` has an entry for every node.
template <class Gaps>
bool is_least_gap(const Gaps &gap, int node)
{
  constexpr DirectionGrid nodes = RadiusMap::nodes;
  const double own = gap[static_cast<std::size_t>(node)];
  for (int down = -1; down <= 1; ++down)
    for (int right = -1; right <= 1; ++right)
    {
      const int other = nodes.neighbour(node / nodes.n_azimuth,
                                        node % nodes.n_azimuth, down, right);
      const double there = gap[static_cast<std::size_t>(other)];
      if (there < own || (there == own && other < node))
        return false;
    }
  return true;
}
} // namespace dem
