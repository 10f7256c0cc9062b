#include <fem/ground_axis.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>

namespace fem
{
namespace
{
/// Whether a cell, seen from above, has the axis in it or on its rim: its
/// corners leave no open half-plane.
bool is_round_axis(const SolidMesh &mesh, std::size_t cell)
{
  std::array<double, 8> angles{};
  for (std::size_t v = 0; v < 8; ++v)
  {
    const auto &at = mesh.nodes[static_cast<std::size_t>(mesh.cells[cell][v])];
    angles[v] = std::atan2(at.y(), at.x());
  }
  std::ranges::sort(angles);
  double widest = angles.front() + 2. * std::numbers::pi - angles.back();
  for (std::size_t v = 1; v < 8; ++v)
    widest = std::max(widest, angles[v] - angles[v - 1]);
  return widest < std::numbers::pi * (1. + 1e-9);
}
} // namespace

GroundAxis::GroundAxis(const SolidMesh &mesh, std::vector<double> depths)
    : asked(std::move(depths))
{
  constexpr double near = 1e-9; // [m]
  const auto is_on_axis = [&](std::int32_t node)
  {
    const auto &at = mesh.nodes[static_cast<std::size_t>(node)];
    return std::hypot(at.x(), at.y()) < near;
  };
  for (std::size_t k = 0; k < mesh.nodes.size(); ++k)
    if (is_on_axis(static_cast<std::int32_t>(k)))
      nodes.push_back(static_cast<std::int32_t>(k));
  std::ranges::sort(nodes, std::ranges::greater{},
                    [&](std::int32_t node)
                    { return mesh.nodes[static_cast<std::size_t>(node)].z(); });
  std::map<std::int64_t, std::vector<std::size_t>> by_depth;
  for (std::size_t cell = 0; cell < mesh.cells.size(); ++cell)
    if (std::ranges::any_of(mesh.cells[cell], is_on_axis) ||
        is_round_axis(mesh, cell))
    {
      double centre = 0.;
      for (const std::int32_t node : mesh.cells[cell])
      {
        const double z = mesh.nodes[static_cast<std::size_t>(node)].z();
        centre += z / 8.;
        lowest = std::max(lowest, -z);
      }
      by_depth[std::llround(-centre / near)].push_back(cell);
    }
  for (const auto &[depth, cells] : by_depth)
  {
    rings.push_back(cells);
    ring_depth.push_back(static_cast<double>(depth) * near);
  }
}

std::vector<double> GroundAxis::heights(const Solid &ground) const
{
  std::vector<double> result;
  for (const std::int32_t node : nodes)
    result.push_back(ground.mesh().nodes[static_cast<std::size_t>(node)].z());
  return result;
}

std::vector<double> GroundAxis::speeds(const Solid &ground) const
{
  std::vector<double> result;
  for (const std::int32_t node : nodes)
    result.push_back(
        ground.velocities()[static_cast<std::size_t>(node)].norm());
  return result;
}

std::vector<double> GroundAxis::stresses(const Solid &ground) const
{
  std::vector<double> at_centres, result;
  for (const std::vector<std::size_t> &ring : rings)
  {
    double sum = 0.;
    for (const std::size_t cell : ring)
      sum -= ground.stress(cell)[2];
    at_centres.push_back(sum / static_cast<double>(ring.size()));
  }
  for (const double depth : asked)
  {
    if (rings.size() == 1)
    {
      result.push_back(at_centres[0]);
      continue;
    }
    const auto below =
        std::upper_bound(ring_depth.begin() + 1, ring_depth.end() - 1, depth);
    const auto k = static_cast<std::size_t>(below - ring_depth.begin());
    const double share =
        (depth - ring_depth[k - 1]) / (ring_depth[k] - ring_depth[k - 1]);
    result.push_back(std::lerp(at_centres[k - 1], at_centres[k], share));
  }
  return result;
}
} // namespace fem
