#include "closed_mesh.h"

#include "mesh_edges.h"

#include <cmath>
#include <cstdio>
#include <stdexcept>
#include <string>
#include <utility>

namespace dem
{
namespace
{
using Triangle = std::array<std::int32_t, 3>;
using Index = std::size_t;

std::string short_text(double value)
{
  char text[32];
  std::snprintf(text, sizeof text, "%.3g", value);
  return text;
}

void require_closed(const detail::MeshEdges &edges)
{
  if (edges.n_open > 0)
    throw std::invalid_argument(
        "mesh is open: " + std::to_string(edges.n_open) +
        " edges belong to one triangle only, every edge must have two; points "
        "up to " +
        short_text(detail::weld_share) +
        " of its diagonal apart are taken as one");
  if (edges.n_shared > 0)
    throw std::invalid_argument(
        "mesh is not a single surface: " + std::to_string(edges.n_shared) +
        " edges belong to more than two triangles, "
        "every edge must have two");
}

/// Returns the number of bodies.
int turn_outward(TriangleMesh &mesh)
{
  const detail::MeshEdges edges = detail::find_edges(mesh.triangles);
  require_closed(edges);
  const std::vector<detail::MeshBody> bodies =
      detail::turn_one_way(mesh, edges);
  for (const detail::MeshBody &body : bodies)
  {
    double volume = 0.;
    for (const Index t : body.triangles)
      volume += detail::six_volume(mesh, mesh.triangles[t]);
    if (volume < 0.)
      detail::turn_over(mesh, body);
  }
  return static_cast<int>(bodies.size());
}

/// Takes near points as one. Files with few digits need it.
void weld_near(detail::ClosedMesh &closed)
{
  const double tolerance = detail::weld_share * detail::diagonal(closed.mesh);
  TriangleMesh welded = weld(closed.mesh, tolerance);
  if (welded.points.size() == closed.mesh.points.size())
    return;
  closed.weld_distance = tolerance;
  closed.n_welded =
      std::int32_t(closed.mesh.points.size() - welded.points.size());
  closed.mesh = std::move(welded);
}

/// The first point of the mesh is the origin of the sums, so that a mesh far
/// from zero loses no digits.
void add_integrals(detail::ClosedMesh &closed)
{
  TriangleMesh near = closed.mesh;
  for (Vec3 &point : near.points)
    point -= closed.mesh.points[0];
  Vec3 moment = Vec3::Zero();
  for (const Triangle &t : near.triangles)
  {
    const Vec3 &a = near.points[Index(t[0])], &b = near.points[Index(t[1])],
               &c = near.points[Index(t[2])];
    const double volume = detail::six_volume(near, t) / 6.;
    closed.volume += volume;
    closed.area += 0.5 * (b - a).cross(c - a).norm();
    moment += 0.25 * volume * (a + b + c);
  }
  // a box has V^2 / S^3 = 1 / 216 at most; 1e-9 is flat
  if (!(closed.volume > 1e-9 * std::pow(closed.area, 1.5)))
    throw std::invalid_argument("mesh encloses no volume");
  closed.centroid = closed.mesh.points[0] + moment / closed.volume;
}
} // namespace

namespace detail
{
ClosedMesh close_mesh(const TriangleMesh &mesh)
{
  require_sound(mesh);
  ClosedMesh closed;
  closed.mesh = weld(mesh);
  if (find_edges(closed.mesh.triangles).n_open > 0)
    weld_near(closed);
  require_sound(closed.mesh);
  closed.n_bodies = turn_outward(closed.mesh);
  add_integrals(closed);
  return closed;
}
} // namespace detail
} // namespace dem
