#include <coupling/pressed_quads.h>
#include <dem/boundary/facet_surface.h>

#include <algorithm>

namespace coupling
{
namespace
{
constexpr double reach = 0.05; // of the longer diagonal of a quad

using Corners = std::array<dem::Vec3, 4>;

Corners corners_of(const fem::SurfaceMesh &mesh, std::size_t quad)
{
  Corners corners;
  for (std::size_t v = 0; v < 4; ++v)
    corners[v] = mesh.nodes[static_cast<std::size_t>(mesh.quads[quad][v])];
  return corners;
}

/// From a point to the two triangles of a quad [m].
double distance_to(const Corners &x, const dem::Vec3 &point)
{
  const auto to = [&](const std::array<dem::Vec3, 3> &triangle)
  { return (dem::nearest_point(point, triangle).point - point).norm(); };
  return std::min(to({x[0], x[1], x[2]}), to({x[0], x[2], x[3]}));
}
} // namespace

std::vector<std::int32_t> pressed_quads(const fem::SurfaceMesh &mesh,
                                        const dem::Network &network)
{
  std::vector<std::int32_t> pressed;
  for (std::size_t k = 0; k < mesh.quads.size(); ++k)
  {
    const Corners x = corners_of(mesh, k);
    const double near =
        reach * std::max((x[2] - x[0]).norm(), (x[3] - x[1]).norm());
    if (std::ranges::any_of(network.walls, [&](const dem::WallContact &contact)
                            { return distance_to(x, contact.point) < near; }))
      pressed.push_back(static_cast<std::int32_t>(k));
  }
  return pressed;
}
} // namespace coupling
