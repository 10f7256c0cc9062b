#pragma once

#include <dem/shape/radius_map.h>

#include <algorithm>
#include <array>
#include <limits>

namespace dem
{
/// Gaps at the nodes of a map, infinite where nobody looked, with a margin so
/// that every node has all its neighbours beside it.
class NodeGaps
{
public:
  NodeGaps() { value.fill(std::numeric_limits<float>::infinity()); }

  void set(int node, float gap) { value[slot(node)] = gap; }
  float at(int node) const { return value[slot(node)]; }

  /// After the last gap is set: what lies round and beyond the poles.
  void close()
  {
    for (int i = 0; i < nodes.n_polar; ++i)
    {
      value[slot(i, -1)] = value[slot(i, nodes.n_azimuth - 1)];
      value[slot(i, nodes.n_azimuth)] = value[slot(i, 0)];
    }
    turn_over(0, -1);
    turn_over(nodes.n_polar - 1, nodes.n_polar);
  }

  /// Whether no node beside this one has a smaller gap; of equal ones the
  /// first counts.
  bool is_least(int node) const
  {
    const float *const own = &value[slot(node)];
    for (int down = -1; down <= 1; ++down)
      for (int right = -1; right <= 1; ++right)
      {
        const float there = own[down * row + right];
        if (there < *own ||
            (there == *own && neighbour(node, down, right) < node))
          return false;
      }
    return true;
  }

  /// By how much the gap beside a node that is_least() may be smaller still. If
  /// it is convex there, a minimum half a step aside is below the node by at
  /// most half of what the neighbour opposite is above it; as much again is for
  /// gaps by a map that is interpolated. Infinite beside unknown neighbours.
  float may_hide(int node) const
  {
    const float *const own = &value[slot(node)];
    float highest = *own;
    for (int down = -1; down <= 1; ++down)
      for (int right = -1; right <= 1; ++right)
        highest = std::max(highest, own[down * row + right]);
    return highest - *own;
  }

private:
  static constexpr DirectionGrid nodes = RadiusMap::nodes;
  static constexpr int row = nodes.n_azimuth + 2;

  static std::size_t slot(int ring, int column)
  {
    return static_cast<std::size_t>((ring + 1) * row + column + 1);
  }
  static std::size_t slot(int node)
  {
    return slot(node / nodes.n_azimuth, node % nodes.n_azimuth);
  }
  static int neighbour(int node, int down, int right)
  {
    return nodes.neighbour(node / nodes.n_azimuth, node % nodes.n_azimuth, down,
                           right);
  }
  /// Beyond a pole the last ring comes again from the other side.
  void turn_over(int ring, int beyond)
  {
    constexpr int half = nodes.n_azimuth / 2;
    std::copy_n(&value[slot(ring, half - 1)], half + 1,
                &value[slot(beyond, -1)]);
    std::copy_n(&value[slot(ring, 0)], half + 1, &value[slot(beyond, half)]);
  }

  std::array<float, static_cast<std::size_t>((nodes.n_polar + 2) * row)> value;
};
} // namespace dem
