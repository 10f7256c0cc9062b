#pragma once

#include <dem/boundary/plane.h>
#include <dem/contact/forces.h>
#include <dem/parameters.h>
#include <dem/particles.h>
#include <dem/search/near_pairs.h>

namespace dem
{
/// Makes the batch hold these pairs of stones (PairFinder), nearly in their
/// order: of contacts near each other, those that touch come first. Known
/// contacts keep all they carry. What the springs of dropped contacts held is
/// added to `retired`.
void rebuild_pairs(const Particles &particles, const BatchLayout &layout,
                   const std::vector<PairKey> &near, ContactBatch &batch,
                   Dissipation &retired);

/// How far boundaries are looked for: wall_bound plus the margin; facets
/// `reach` times wall_bound plus the margin.
struct WallSearch
{
  BatchLayout layout;
  ContactGeometry geometry = ContactGeometry::ball;
  double margin = 0.; ///< [m]
  double reach = 1.;  ///< [-]
};

/// Likewise all (stone, plane) within reach, in the order (stone, plane).
void rebuild_planes(const Particles &particles,
                    const std::vector<Plane> &planes, const WallSearch &search,
                    ContactBatch &batch, Dissipation &retired);

/// How near to its centre triangles are taken as candidates of a stone [m].
double facet_reach(const Particles &particles, std::size_t stone,
                   const WallSearch &search);

/// The stones near the facet surface and the triangles within reach.
FacetCandidates near_facets(const Particles &particles,
                            const FacetSurface &surface,
                            const WallSearch &search);

/// Likewise the stones near the facet surface and the triangles within reach.
void rebuild_facets(const Particles &particles, const FacetSurface &surface,
                    const WallSearch &search, FacetCandidates &candidates,
                    ContactBatch &batch, Dissipation &retired);

/// c of (1 + c)|v| + reach |omega|, the bound of the speed at which a stone can
/// close a gap, where overlap is of local radii along the branch: largest
/// max_slope / least_radius [-].
double steepness(const Particles &particles);
} // namespace dem
