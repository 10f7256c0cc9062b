#pragma once

#include <dem/vector.h>

#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace dem
{
/// A triangulated boundary that is moved from outside and returns loads.
/// Triangles are counter-clockwise seen from the outside; particles are inside.
struct FacetSurface
{
  std::vector<std::array<std::int32_t, 3>> triangles; ///< vertex numbers
  std::vector<Vec3> position;                         ///< of vertices [m]
  std::vector<Vec3> velocity;                         ///< of vertices [m/s]
  /// Effective mass of vertices for the dashpot; infinite if prescribed [kg].
  std::vector<double> mass;
  std::vector<Vec3> load; ///< force of the particles on vertices, out [N]
};

enum class Feature : std::uint8_t
{
  face,
  edge,
  vertex
};

/// Nearest point of one triangle.
struct NearestPoint
{
  std::int32_t triangle = -1;
  Feature feature = Feature::face;
  /// Number of the edge (0: 0-1, 1: 1-2, 2: 2-0) or corner, in the triangle.
  std::int32_t which = 0;
  std::array<double, 3> weight{}; ///< barycentric, sum 1 [-]
  Vec3 point = Vec3::Zero();      ///< [m]
};

/// Nearest point of the triangle to x, with its feature: region test, always
/// finite; a triangle thinner than 1e-6 of its size is its three sides.
NearestPoint nearest_point(const Vec3 &x, const std::array<Vec3, 3> &corner);

/// Who shares an edge or a corner: made once per surface. Throws
/// std::invalid_argument on a facet with an unknown or repeated vertex or
/// without area, an edge of three facets, facets of opposite orientation.
struct FacetTopology
{
  explicit FacetTopology(const FacetSurface &surface);

  /// Triangle on the other side of each edge; -1 at a rim.
  std::vector<std::array<std::int32_t, 3>> neighbour;
  /// Triangles round each vertex, in rows.
  std::vector<std::int32_t> row_start, row_triangle;
  /// 1 - triangles + shared edges of each vertex: how it counts where pieces of
  /// the surface are added up without counting what they share twice; 1 inside,
  /// 0 at a rim [-].
  std::vector<std::int32_t> count;
};

/// A surface with who shares what in it.
struct FacetMesh
{
  const FacetSurface &surface;
  const FacetTopology &topology;
};

/// Corners of a triangle [m].
inline std::array<Vec3, 3> corners_of(const FacetSurface &surface,
                                      std::int32_t triangle)
{
  const auto &vertex = surface.triangles[static_cast<std::size_t>(triangle)];
  return {surface.position[static_cast<std::size_t>(vertex[0])],
          surface.position[static_cast<std::size_t>(vertex[1])],
          surface.position[static_cast<std::size_t>(vertex[2])]};
}

/// One contact of a particle with one smooth patch of the surface.
struct NearestFacetPoint
{
  NearestPoint nearest;
  Vec3 direction = Vec3::UnitZ(); ///< unit, from the particle's centre [-]
  double distance = 0.;           ///< centre to nearest point [m]
};

/// The nearest point of one triangle, as if it were touched there (without
/// direction).
NearestFacetPoint nearest_on_facet(const FacetSurface &surface,
                                   std::int32_t triangle, const Vec3 &x);

/// Of the nearest points of triangles (nearest_on_facet, in any order) keeps
/// the local minima of the distance from x to the surface, one per smooth
/// patch: a point on an edge or a vertex counts only if no triangle that shares
/// the feature comes nearer (face before edge before vertex), and of several
/// minima whose directions are within 45 degrees only the nearest is kept.
/// Order: by distance, then triangle. The mesh is conforming (neighbours share
/// vertex numbers). At distance zero the direction is the outward normal.
void keep_minima(const FacetSurface &surface, const FacetTopology &topology,
                 const Vec3 &x, std::vector<NearestFacetPoint> &touches);

/// Part of one vertex in a contact.
struct VertexShare
{
  std::int64_t vertex = 0; ///< as wide as the rest: no gaps in a checkpoint
  double weight = 0.;      ///< of forces across the normal; sum 1 [-]
  /// Load by a unit of normal force, and normal velocity of the contact by one
  /// of the vertex; sums to the normal [-].
  Vec3 along = Vec3::Zero();
};

/// The vertices that carry a contact on several facets, as many as there are.
struct FacetShares
{
  std::int64_t walls = 1; ///< facets that press, what they share taken off
  /// Overlap beyond that with the plane through the touch's point [m].
  double extra = 0.;
  std::vector<VertexShare> of; ///< empty: on the nearest facet alone

  /// The same without giving memory back: a step takes none once it has grown.
  void clear()
  {
    walls = 1;
    extra = 0.;
    of.clear();
  }
};

/// A sphere, and the exponent of its force in the overlap with the surface.
struct PressedSphere
{
  Vec3 centre = Vec3::Zero();
  double radius = 0.; ///< [m]
  double power = 1.;  ///< linear 1, Hertz 3/2 [-]
};

/// Lets all facets that the sphere overlaps carry it, where these are several:
/// its force on a patch is that of the energy of all of them, what they share
/// counted once (docs/theory/facets.md). `near` has the nearest points of all
/// triangles that it overlaps, `touches` what keep_minima leaves of these; of a
/// touch that several carry, direction, point and distance of that along the
/// direction are set again, `shares` gets one row per touch, or keeps more. The
/// number of facets and vertices is not limited.
void share_patches(const FacetMesh &mesh, const PressedSphere &sphere,
                   const std::vector<NearestFacetPoint> &near,
                   std::vector<NearestFacetPoint> &touches,
                   std::vector<FacetShares> &shares);
} // namespace dem
