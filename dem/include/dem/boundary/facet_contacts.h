#pragma once

#include <dem/boundary/facet_surface.h>
#include <dem/contact/forces.h>

#include <array>
#include <span>
#include <vector>

namespace dem
{
/// Slots per particle at the facet surface: most smooth patches it may touch.
inline constexpr int slots_per_particle = 4;

/// Where a contact with the facet surface presses.
struct FacetContactPoint
{
  std::int64_t triangle = -1;
  std::array<double, 3> weight{}; ///< barycentric [-]
  Vec3 normal = Vec3::UnitX();    ///< from the particle to the surface [-]
  FacetShares shares = {};        ///< of vertices, if several facets carry it
};

/// Calls call(share) for every vertex that carries the contact.
template <class Call>
void for_shares(const FacetSurface &surface,
                const FacetContactPoint &contact_point, const Call &call)
{
  for (const VertexShare &share : contact_point.shares.of)
    call(share);
  if (!contact_point.shares.of.empty())
    return;
  const auto &corner =
      surface.triangles[static_cast<std::size_t>(contact_point.triangle)];
  for (std::size_t c = 0; c < 3; ++c)
    call(VertexShare{corner[c], contact_point.weight[c],
                     contact_point.weight[c] * contact_point.normal});
}

/// Calls call(vertex, part) for every vertex with its part of a force of the
/// contact [N].
template <class Call>
void for_loads(const FacetSurface &surface,
               const FacetContactPoint &contact_point, const Vec3 &force,
               const Call &call)
{
  const double pressing = force.dot(contact_point.normal);
  const Vec3 across = force - pressing * contact_point.normal;
  for_shares(surface, contact_point,
             [&](const VertexShare &share)
             {
               call(static_cast<std::size_t>(share.vertex),
                    Vec3(pressing * share.along + share.weight * across));
             });
}

/// Where that is now [m].
inline Vec3 point_at(const FacetSurface &surface,
                     const FacetContactPoint &contact_point)
{
  Vec3 point = Vec3::Zero();
  for_shares(surface, contact_point,
             [&](const VertexShare &share)
             {
               point +=
                   share.weight *
                   surface.position[static_cast<std::size_t>(share.vertex)];
             });
  return point;
}

/// Particles near the facet surface with the triangles each may reach.
struct FacetCandidates
{
  std::vector<std::int32_t> particle;
  std::vector<std::int32_t> row_start{0}; ///< size particles + 1
  std::vector<std::int32_t> triangle;
  /// A triangle need not be checked before ForceContext::path_length has come
  /// this far; empty where particles follow their surfaces [m].
  std::vector<double> triangle_reactivation;
  /// The same of a particle without contact [m].
  std::vector<double> reactivation;

  /// Candidates of the particle in this row.
  std::span<const std::int32_t> triangles_of(std::size_t row) const
  {
    return std::span(triangle).subspan(
        static_cast<std::size_t>(row_start[row]),
        static_cast<std::size_t>(row_start[row + 1] - row_start[row]));
  }

  /// Some rows, in this order.
  FacetCandidates select(const std::vector<std::int32_t> &rows) const;
  /// Adds rows at the end.
  void append(const FacetCandidates &more);

  /// Calls call(column) for all that a checkpoint stores.
  template <class Self, class Column>
  static void visit(Self &self, const Column &column)
  {
    column(self.particle);
    column(self.row_start);
    column(self.triangle);
    column(self.triangle_reactivation);
    column(self.reactivation);
  }
};

/// What a contact has in common with others over the ridges between their
/// contact points: share_ridges(). `e` is the exponent of the law.
struct FacetRidge
{
  double depth = 0.;  ///< of its contact point [m]
  double force = 0.;  ///< its shares of the ridges to the power e [m^e]
  double energy = 0.; ///< and to the power e + 1 [m^(e + 1)]
};

/// What contacts with a facet surface store besides their batch. Balls have
/// slots_per_particle contacts for each row of the candidates, which stand in
/// the same order.
struct FacetContactPoints
{
  std::vector<FacetContactPoint> point;
  /// Where particles follow their surfaces: a contact need not be looked at
  /// before the path lengths of particle and surface have come this far [m].
  std::vector<double> reactivation;
  std::vector<FacetRidge> ridge; ///< where particles follow their surfaces

  FacetContactPoints select(const std::vector<std::int32_t> &contacts) const;
  void append(const FacetContactPoints &more);
};

/// Finds where the particles meet the facet surface, one slot per smooth patch;
/// history stays with the patch, matched by direction, when the facet changes.
/// Balls share their load between the facets that they overlap
/// (share_patches()). `rows` gets the wall of every slot, `extra` its
/// Walls::extra.
void find_facets(const ForceContext &context, const FacetMesh &mesh,
                 const ContactBatch &batch, FacetCandidates &candidates,
                 std::vector<FacetContactPoint> &contact_points,
                 std::vector<WallRow> &rows, std::vector<double> &extra);

/// The surface at one of its contact_points, as a contact meets it that was
/// `before` in the last step.
WallRow facet_row(const FacetSurface &surface, const FacetContactPoint &now,
                  const FacetContactPoint &before);
} // namespace dem
