#pragma once

#include <dem/boundary/plane.h>
#include <dem/contact/batch.h>
#include <dem/parameters.h>
#include <dem/particles.h>

#include <span>

namespace dem
{
/// No wall farther than this from the centre can touch the stone [m].
inline double wall_bound(const Particles &particles, std::size_t stone,
                         ContactGeometry geometry)
{
  return geometry == ContactGeometry::ball
             ? particles.radius[stone]
             : particles.body[stone].circumscribed_radius;
}

/// What every force loop reads.
struct ForceContext
{
  const EngineParameters &parameters;
  const PairElasticity &elasticity; ///< stone against stone
  const Particles &particles;
  double time_step = 0.; ///< [s]
  /// Sum over all steps of how far the two fastest stones could have closed a
  /// gap [m].
  double travelled = 0.;
};

/// Stone against stone: rolling-resistant elliptic Hertz. Returns true if some
/// side asks for breakage (ContactBatch::event).
bool pair_forces(const ForceContext &context, ContactBatch &batch);

/// Stone against plane: linear springs. `b` is the plane.
bool plane_forces(const ForceContext &context, const std::vector<Plane> &planes,
                  ContactBatch &batch);

/// Slots per stone at the facet surface: most smooth patches it may touch.
inline constexpr int slots_per_stone = 4;

/// Stones near the facet surface with the triangles each may reach, and the
/// contact slots of each (slots_per_stone in a row, in the batch).
struct FacetCandidates
{
  std::vector<std::int32_t> stone;
  std::vector<std::int32_t> row_start; ///< size stones + 1
  std::vector<std::int32_t> triangle;
  std::vector<FacetSpot> spot; ///< of each slot
  /// A stone without contact need not be looked at before
  /// ForceContext::travelled has come this far [m].
  std::vector<double> wake;

  /// Candidates of the stone in this row.
  std::span<const std::int32_t> triangles_of(std::size_t row) const
  {
    return std::span(triangle).subspan(
        static_cast<std::size_t>(row_start[row]),
        static_cast<std::size_t>(row_start[row + 1] - row_start[row]));
  }
};

/// Stone against facet surface: linear springs, one contact per smooth patch;
/// history stays with the patch, matched by direction, when the facet changes.
bool facet_forces(const ForceContext &context, const FacetSurface &surface,
                  const FacetTopology &topology, FacetCandidates &candidates,
                  ContactBatch &batch);

/// Adds the loads of the contacts to the vertices of the surface.
void load_surface(const FacetCandidates &candidates, const ContactBatch &batch,
                  FacetSurface &surface);

/// Geometry and forces of contact k as they stand, no time passing: after one
/// of its stones has changed its shape. Springs are capped anew; the energy
/// that they give up is returned [J].
double reset_pair(const ForceContext &context, ContactBatch &batch,
                  std::size_t k);
double reset_plane(const ForceContext &context,
                   const std::vector<Plane> &planes, ContactBatch &batch,
                   std::size_t k);
double reset_facet(const ForceContext &context, const FacetSurface &surface,
                   const FacetCandidates &candidates, ContactBatch &batch,
                   std::size_t k);
} // namespace dem
