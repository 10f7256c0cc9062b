#include "face_points.h"

#include <fem/solid_surface.h>

#include <algorithm>
#include <map>
#include <stdexcept>
#include <string>

namespace fem
{
namespace
{
using Numbers = std::map<std::int32_t, std::int32_t>;

/// The ends of the edge that a hanging node halves, in numbers of the surface.
SurfaceMesh::Midpoint midpoint(const HangingNode &hanging,
                               const Numbers &number)
{
  const auto &parents = hanging.parents;
  if (parents.size() != 2 || !number.contains(parents[0].first) ||
      !number.contains(parents[1].first))
    throw std::invalid_argument("solid mesh: hanging node " +
                                std::to_string(hanging.node) +
                                " is on no edge of its boundary");
  return {number.at(hanging.node),
          {number.at(parents[0].first), number.at(parents[1].first)}};
}
} // namespace

std::vector<std::int32_t> boundary_nodes(const SolidMesh &mesh,
                                         std::int32_t boundary)
{
  std::vector<std::int32_t> nodes;
  for (const SolidMesh::Face &face : mesh.faces)
    if (face.boundary == boundary)
      nodes.insert(nodes.end(), face.corners.begin(), face.corners.end());
  if (nodes.empty())
    throw std::invalid_argument("solid mesh: no faces on boundary " +
                                std::to_string(boundary));
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  return nodes;
}

SolidSurface boundary_surface(const SolidMesh &mesh, std::int32_t boundary)
{
  SolidSurface surface;
  surface.node = boundary_nodes(mesh, boundary);
  std::map<std::int32_t, const HangingNode *> hanging;
  for (const HangingNode &follower : mesh.hanging)
    hanging[follower.node] = &follower;
  std::stable_partition(surface.node.begin(), surface.node.end(),
                        [&](std::int32_t node)
                        { return !hanging.contains(node); });
  Numbers number;
  for (const std::int32_t node : surface.node)
  {
    number[node] = static_cast<std::int32_t>(surface.mesh.nodes.size());
    surface.mesh.nodes.push_back(mesh.nodes[static_cast<std::size_t>(node)]);
  }
  for (const SolidMesh::Face &face : mesh.faces)
  {
    if (face.boundary != boundary)
      continue;
    auto &quad = surface.mesh.quads.emplace_back();
    for (std::size_t v = 0; v < 4; ++v)
      quad[v] = number[face.corners[v]];
  }
  for (const std::int32_t node : surface.node)
    if (const auto found = hanging.find(node); found != hanging.end())
      surface.mesh.midpoints.push_back(midpoint(*found->second, number));
  return surface;
}

void send_motion(const Solid &solid, const SolidSurface &surface,
                 std::span<Eigen::Vector3d> positions,
                 std::span<Eigen::Vector3d> velocities)
{
  for (std::size_t k = 0; k < surface.node.size(); ++k)
  {
    const auto node = static_cast<std::size_t>(surface.node[k]);
    positions[k] = surface.mesh.nodes[k] + solid.displacements()[node];
    velocities[k] = solid.velocities()[node];
  }
}

void add_loads(const SolidSurface &surface,
               std::span<const Eigen::Vector3d> loads,
               std::span<Eigen::Vector3d> body_loads)
{
  for (std::size_t k = 0; k < surface.node.size(); ++k)
    body_loads[static_cast<std::size_t>(surface.node[k])] += loads[k];
}

std::vector<Eigen::Vector3d> traction_loads(const SolidMesh &mesh,
                                            std::int32_t boundary,
                                            const Traction &traction,
                                            int n_parts)
{
  std::vector<Eigen::Vector3d> loads(mesh.nodes.size(),
                                     Eigen::Vector3d::Zero());
  for (const SolidMesh::Face &face : mesh.faces)
  {
    if (face.boundary != boundary)
      continue;
    for (const FacePoint &point : face_points(mesh, face, n_parts))
    {
      const Eigen::Vector3d force =
          point.area.norm() * traction(point.position);
      for (std::size_t v = 0; v < 4; ++v)
        loads[static_cast<std::size_t>(face.corners[v])] +=
            point.value[v] * force;
    }
  }
  return loads;
}
} // namespace fem
