#pragma once

#include <dem/boundary/plane.h>
#include <dem/contact/forces.h>
#include <dem/parameters.h>
#include <dem/particle_system.h>
#include <dem/search/near_pairs.h>

namespace dem
{
/// Makes the batch hold these pairs of particles (PairFinder), nearly in their
/// order: of contacts near each other, those that touch come first. Known
/// contacts keep all they carry. What the springs of dropped contacts held is
/// added to `retired`.
void rebuild_pairs(const ParticleSystem &particles, const BatchLayout &layout,
                   const std::vector<PairKey> &near, ContactBatch &batch,
                   Dissipation &retired);

/// How far boundaries are looked for: wall_bound plus the margin; facets
/// `reach` times wall_bound plus the margin.
struct WallSearch
{
  BatchLayout layout;
  ContactGeometry geometry = ContactGeometry::sphere;
  double margin = 0.; ///< [m]
  double reach = 1.;  ///< [-]
};

/// Likewise all (particle, plane) within reach, in the order (particle, plane).
void rebuild_planes(const ParticleSystem &particles,
                    const std::vector<Plane> &planes, const WallSearch &search,
                    ContactBatch &batch, Dissipation &retired);

/// How near to its centre triangles are taken as candidates of a particle [m].
double facet_reach(const ParticleSystem &particles, std::size_t particle,
                   const WallSearch &search);

/// The particles near the facet surface and the triangles within reach.
FacetCandidates near_facets(const ParticleSystem &particles,
                            const FacetSurface &surface,
                            const WallSearch &search);

/// Likewise the particles near the facet surface and the triangles within
/// reach.
void rebuild_facets(const ParticleSystem &particles,
                    const FacetSurface &surface, const WallSearch &search,
                    FacetCandidates &candidates, ContactBatch &batch,
                    Dissipation &retired);

/// c of (1 + c)|v| + reach |omega|, the bound of the speed at which a particle
/// can close a gap, where overlap is of local radii along the branch: largest
/// max_slope / least_radius [-].
double steepness(const ParticleSystem &particles);
} // namespace dem
