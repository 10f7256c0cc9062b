#pragma once

#include "surface_simd.h"

/// Particles whose contact points on walls were found before the loop, in
/// lanes.
namespace dem::kernel
{
namespace
{
/// The contact is half way between the wall, where the row is, and the
/// particle.
SupportGeometry followed_geometry(const Task &task, std::int64_t k,
                                  const ParticleSimd &a, const WallSimd &wall,
                                  const SimdMask &is_valid)
{
  const std::int32_t *row = task.contacts.b + k;
  const Simd depth([&task, row](auto lane)
                   { return task.wall_overlap[row[lane]]; });
  const SimdMask is_open =
      load(task.contacts.overlap_offset + k) >= closed_offset;
  const SimdMask is_there = is_valid && !is_open;
  SupportGeometry geometry;
  geometry.overlap =
      counted_overlap(task, k, select(is_there, depth, Simd(0.)));
  geometry.arm = wall.vector(at_point) - a.vector(at_position) +
                 0.5 * depth * wall.vector(at_normal);
  return geometry;
}

template <class Law>
[[gnu::flatten]] void advance_followed_walls(const Task &task, std::int64_t k,
                                             int n_valid, LaneSums &sums,
                                             const Target &target)
{
  const ParticleSimd a(task.particles.state, task.contacts.a + k);
  const WallSimd wall(task.walls, task.contacts.b + k);
  advance_at_wall<Law>(
      task, k, n_valid, a, wall,
      followed_geometry(task, k, a, wall, valid_lanes(n_valid)), sums, target);
}
} // namespace
} // namespace dem::kernel
