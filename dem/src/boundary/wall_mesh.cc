#include "../shape/mesh_edges.h"

#include <dem/boundary/wall_mesh.h>

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <string>

namespace dem
{
namespace
{
/// Welded, and welded wider where it is open so; what is open then stays open.
TriangleMesh joined(const TriangleMesh &mesh)
{
  TriangleMesh welded = weld(mesh);
  detail::require_sound(welded);
  if (detail::find_edges(welded.triangles).n_open == 0)
    return welded;
  return weld(welded, detail::weld_share * detail::diagonal(welded));
}

bool is_closed(const detail::MeshBody &body, const detail::MeshEdges &edges)
{
  return std::ranges::all_of(body.triangles, [&edges](std::size_t t)
                             { return edges.links[t].size() == 3; });
}

/// Six times the volume about a point of the body: no digits are lost where it
/// is far from the origin [m^3].
double volume_of(const TriangleMesh &mesh, const detail::MeshBody &body)
{
  const auto point = [&mesh](std::size_t t, std::size_t c)
  { return mesh.points[static_cast<std::size_t>(mesh.triangles[t][c])]; };
  const Vec3 origin = point(body.triangles[0], 0);
  double volume = 0.;
  for (const std::size_t t : body.triangles)
    volume += (point(t, 0) - origin)
                  .dot((point(t, 1) - origin).cross(point(t, 2) - origin));
  return volume;
}

/// A closed body outward, an open one as most of its triangles were.
void turn(TriangleMesh &mesh, const detail::MeshBody &body, bool closed)
{
  if (closed ? volume_of(mesh, body) < 0.
             : 2 * body.n_turned > body.triangles.size())
    detail::turn_over(mesh, body);
}
} // namespace

FacetSurface wall_surface(const TriangleMesh &mesh, WallSide side)
{
  detail::require_sound(mesh);
  TriangleMesh wall = joined(mesh);
  detail::require_sound(wall);
  const detail::MeshEdges edges = detail::find_edges(wall.triangles);
  if (edges.n_shared > 0)
    throw std::invalid_argument(
        "mesh is no surface: " + std::to_string(edges.n_shared) +
        " edges belong to more than two triangles, at most two are allowed");
  for (const detail::MeshBody &body : detail::turn_one_way(wall, edges))
  {
    turn(wall, body, is_closed(body, edges));
    if (side == WallSide::outside) // facets show away from the particles
      detail::turn_over(wall, body);
  }
  const std::size_t n = wall.points.size();
  FacetSurface surface;
  surface.triangles = std::move(wall.triangles);
  surface.position = std::move(wall.points);
  surface.velocity.assign(n, Vec3::Zero());
  surface.mass.assign(n, std::numeric_limits<double>::infinity());
  surface.load.assign(n, Vec3::Zero());
  return surface;
}
} // namespace dem
