#pragma once

#include "map_kernels.h"

#include <dem/neighbor/contact_points.h>

#include <array>

namespace dem
{
/// Some nodes of the map of a particle, as points of its body frame [m].
class NodeList
{
public:
  /// Those higher than `lowest` [m] along a unit vector of the body frame.
  NodeList(const MappedParticle &particle, const Vec3 &up, double lowest);

  int size() const { return n; }
  int node(int k) const { return nodes[static_cast<std::size_t>(k)]; }
  Vec3 position(int k) const;
  kernel::PointRows points() { return {x.data(), y.data(), z.data()}; }

private:
  template <class Number>
  using Column = std::array<Number, kernel::map_nodes + kernel::map_spare>;

  int n = 0;
  Column<std::int32_t> nodes;
  Column<float> x, y, z;
};

/// Gaps of n points from a particle by its map: along the ray from its centre,
/// times the cosine between ray and normal there, < 0 inside; infinite beyond
/// `range` from its circumscribed sphere [m]. The pose is that of the particle
/// in the frame of the points; all have room for kernel::map_spare entries
/// more.
void find_gaps(const MappedParticle &particle, const RelativePose &pose,
               double range, const kernel::PointRows &points, int n,
               float *gap);
} // namespace dem
