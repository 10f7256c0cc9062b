#include "mesh_checks.h"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <utility>

namespace fem
{
namespace
{
[[noreturn]] void refuse(const std::string &what)
{
  throw std::invalid_argument("membrane mesh: " + what);
}

void check_nodes(const SurfaceMesh &mesh)
{
  if (mesh.quads.empty())
    refuse("no quads");
  for (const Eigen::Vector3d &node : mesh.nodes)
    if (!node.allFinite())
      refuse("a node has a coordinate that is not a number");

  std::vector<bool> used(mesh.nodes.size(), false);
  for (const auto &quad : mesh.quads)
    for (const std::int32_t node : quad)
    {
      if (node < 0 || static_cast<std::size_t>(node) >= mesh.nodes.size())
        refuse("node number " + std::to_string(node) + ", there are " +
               std::to_string(mesh.nodes.size()) + " nodes");
      used[static_cast<std::size_t>(node)] = true;
    }
  const auto unused = std::find(used.begin(), used.end(), false);
  if (unused != used.end())
    refuse("node " + std::to_string(unused - used.begin()) +
           " belongs to no quad");
}

/// Of nodes that the quads use.
void check_midpoints(const SurfaceMesh &mesh)
{
  std::vector<bool> hangs(mesh.nodes.size(), false);
  const auto mark = [&](std::int32_t node) -> std::vector<bool>::reference
  {
    if (node < 0 || static_cast<std::size_t>(node) >= hangs.size())
      refuse("node number " + std::to_string(node) +
             " of a midpoint, there are " + std::to_string(hangs.size()) +
             " nodes");
    return hangs[static_cast<std::size_t>(node)];
  };
  for (const SurfaceMesh::Midpoint &middle : mesh.midpoints)
    mark(middle.node) = true;
  for (const SurfaceMesh::Midpoint &middle : mesh.midpoints)
  {
    for (const std::int32_t end : middle.ends)
      if (mark(end))
        refuse("node " + std::to_string(middle.node) +
               " is in the middle of an edge whose end " + std::to_string(end) +
               " is in the middle of another");
    const auto at = [&](std::int32_t node) -> const Eigen::Vector3d &
    { return mesh.nodes[static_cast<std::size_t>(node)]; };
    const Eigen::Vector3d &a = at(middle.ends[0]), &b = at(middle.ends[1]);
    if ((at(middle.node) - 0.5 * (a + b)).norm() > 1e-9 * (b - a).norm())
      refuse("node " + std::to_string(middle.node) +
             " is not in the middle of its edge");
  }
}

/// The cross products at the four corners must point to one side.
void check_shapes(const SurfaceMesh &mesh)
{
  for (std::size_t k = 0; k < mesh.quads.size(); ++k)
  {
    std::array<Eigen::Vector3d, 4> x, corner;
    for (std::size_t v = 0; v < 4; ++v)
      x[v] = mesh.nodes[static_cast<std::size_t>(mesh.quads[k][v])];
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (std::size_t v = 0; v < 4; ++v)
    {
      corner[v] = (x[(v + 1) % 4] - x[v]).cross(x[(v + 3) % 4] - x[v]);
      sum += corner[v];
    }
    for (std::size_t v = 0; v < 4; ++v)
      if (!(corner[v].dot(sum) > 1e-9 * sum.squaredNorm()))
        refuse("quad " + std::to_string(k) +
               " is degenerate or has a re-entrant corner");
  }
}

void check_edges(const SurfaceMesh &mesh)
{
  std::vector<std::pair<std::int32_t, std::int32_t>> edges;
  for (const auto &quad : mesh.quads)
    for (std::size_t v = 0; v < 4; ++v)
      edges.emplace_back(quad[v], quad[(v + 1) % 4]);
  std::sort(edges.begin(), edges.end());
  const auto twice = std::adjacent_find(edges.begin(), edges.end());
  if (twice != edges.end())
    refuse("edge " + std::to_string(twice->first) + "-" +
           std::to_string(twice->second) +
           " is traversed twice in the same direction: the quads round it "
           "are turned differently or more than two");
}
} // namespace

void check_mesh(const SurfaceMesh &mesh)
{
  check_nodes(mesh);
  check_midpoints(mesh);
  check_shapes(mesh);
  check_edges(mesh);
}
} // namespace fem
