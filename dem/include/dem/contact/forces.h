#pragma once

#include <dem/boundary/facet_surface.h>
#include <dem/boundary/plane.h>
#include <dem/contact/batch.h>
#include <dem/contact/elasticity_table.h>
#include <dem/contact/overlap_watch.h>
#include <dem/contact/pair_loads.h>
#include <dem/contact/range_sum.h>
#include <dem/parameters.h>
#include <dem/particle_system.h>

#include <functional>
#include <span>

namespace dem
{
/// No wall farther than this from the centre can touch the particle [m].
inline double wall_bound(const ParticleSystem &particles, std::size_t particle,
                         ContactGeometry geometry)
{
  return geometry == ContactGeometry::sphere
             ? particles.radius(particle)
             : particles.shape[particle].circumscribed_radius;
}

/// What every force loop reads, and the particles whose force and moment it
/// adds to.
struct ForceContext
{
  const EngineParameters &parameters;
  const ElasticityTable &elasticity;
  ParticleSystem &particles;
  double time_step = 0.; ///< [s]
  /// Sum over all steps of how far the fastest particle and boundary could have
  /// closed a gap [m].
  double travelled = 0.;
  double stride = 0.; ///< of it, in the last step [m]
  /// Travel::gaps: of any two spheres. Where there are shapes
  /// Particles::travelled says it by particle.
  double gaps_travelled = 0.;
  /// Forces stay as the last step left them, only loads are added: after some
  /// contacts were reset.
  bool adds_loads_only = false;
  /// No overlap up to this exceeds the recent ratios of OverlapRecord [m].
  double known_overlap = 0.;
};

/// Which columns the contacts of a scene need.
BatchLayout pair_layout(const EngineParameters &parameters,
                        const ParticleSystem &particles);
BatchLayout wall_layout(const EngineParameters &parameters,
                        const WallMaterial &wall,
                        const ParticleSystem &particles);

/// What the loops have lost and whether some side asks for breakage
/// (ContactBatch::event).
struct ForceSum
{
  Dissipation lost;
  bool wants_breakage = false;
  bool has_switched = false;  ///< as RangeSum
  bool has_displaced = false; ///< as RangeSum
  int n_jumps = 0;
  int n_ended = 0;
  double overlap_ratio = 0.; ///< as RangeSum [-]

  ForceSum &operator+=(const ForceSum &part);
};

/// A boundary as one particle meets it at one contact: the plane through
/// `point`.
struct WallRow
{
  Vec3 point = Vec3::Zero();
  Vec3 normal = Vec3::UnitZ();         ///< from the particle to the wall [-]
  Vec3 velocity = Vec3::Zero();        ///< of the wall at the contact [m/s]
  Vec3 velocity_before = Vec3::Zero(); ///< where the contact was [m/s]
  Vec3 normal_before = Vec3::UnitZ();  ///< there [-]
  double inverse_mass = 0.;            ///< effective, of the wall [1/kg]
};

/// Particle against particle: rolling-resistant elliptic Hertz. Loads are added
/// to the particles by way of `loads`. `ranges` is space to work in.
ForceSum pair_forces(const ForceContext &context, ContactBatch &batch,
                     PairLoads &loads, std::vector<RangeSum> &ranges);

/// The walls of one kind as their contacts see them: `b` is the row.
struct Walls
{
  const WallMaterial &material;     ///< of all of them
  const std::vector<WallRow> &rows; ///< as they stand in this step
  /// Overlaps by row, where the places of particles that follow their surfaces
  /// were found before the forces (place_on_drum(), place_on_facets()) [m].
  std::span<const double> overlap = {};
  /// By row, where several facets may carry a contact: overlap beyond that with
  /// the plane of the row (FacetShares::extra) [m].
  std::span<const double> extra = {};
  /// Finds the place of contact k anew, if they were.
  std::function<void(std::size_t)> replace = {};
};

/// Particle against wall: by the law of the wall. Loads are added to the
/// particles.
ForceSum wall_forces(const ForceContext &context, const Walls &walls,
                     ContactBatch &batch, std::vector<RangeSum> &ranges);

/// Planes as rows, in their order.
void plane_rows(const std::vector<Plane> &planes, std::vector<WallRow> &rows);

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

/// Particles near the facet surface with the triangles each may reach, and the
/// contact slots of each (slots_per_particle in a row, in the batch).
struct FacetCandidates
{
  std::vector<std::int32_t> particle;
  std::vector<std::int32_t> row_start; ///< size particles + 1
  std::vector<std::int32_t> triangle;
  /// A triangle need not be looked at before ForceContext::travelled has come
  /// this far; empty where particles follow their surfaces [m].
  std::vector<double> triangle_reactivation;
  std::vector<FacetContactPoint> contact_point; ///< of each slot
  /// A particle without contact need not be looked at before
  /// ForceContext::travelled has come this far; where particles follow their
  /// surfaces one for each contact, of the travel of particle and surface [m].
  std::vector<double> reactivation;

  /// Candidates of the particle in this row.
  std::span<const std::int32_t> triangles_of(std::size_t row) const
  {
    return std::span(triangle).subspan(
        static_cast<std::size_t>(row_start[row]),
        static_cast<std::size_t>(row_start[row + 1] - row_start[row]));
  }
};

/// Finds where the particles meet the facet surface, one slot per smooth patch;
/// history stays with the patch, matched by direction, when the facet changes.
/// Balls share their load between the facets that they overlap
/// (share_patches()). `rows` gets the wall of every slot, `extra` its
/// Walls::extra.
void find_facets(const ForceContext &context, const FacetMesh &mesh,
                 const ContactBatch &batch, FacetCandidates &candidates,
                 std::vector<WallRow> &rows, std::vector<double> &extra);

/// The surface at one of its contact_points, as a contact meets it that was
/// `before` in the last step.
WallRow facet_row(const FacetSurface &surface, const FacetContactPoint &now,
                  const FacetContactPoint &before);

/// Adds the loads of the contacts to the vertices of the surface.
void load_surface(const FacetCandidates &candidates, const ContactBatch &batch,
                  FacetSurface &surface);

/// Geometry and forces of contact k as they stand, no time passing: after one
/// of its particles has changed its shape. Springs are capped anew; the energy
/// that they give up is returned [J]. The loads of the particles are left
/// wrong: all loops must run again.
double reset_pair(const ForceContext &context, ContactBatch &batch,
                  std::size_t k);
double reset_wall(const ForceContext &context, const Walls &walls,
                  ContactBatch &batch, std::size_t k);
} // namespace dem
