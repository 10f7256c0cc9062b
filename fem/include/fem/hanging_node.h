#pragma once

#include <cstdint>
#include <utility>
#include <vector>

namespace fem
{
/// A node where small elements meet the inside of a side of a larger one: it
/// moves with the corners of that side, x = sum of weight x_parent.
struct HangingNode
{
  std::int32_t node = 0;
  std::vector<std::pair<std::int32_t, double>> parents; ///< weights [-]
};
} // namespace fem
