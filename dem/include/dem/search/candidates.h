#pragma once

#include <dem/boundary/plane.h>
#include <dem/contact/forces.h>
#include <dem/parameters.h>
#include <dem/particles.h>
#include <dem/search/near_pairs.h>

namespace dem
{
/// Makes the batch hold these pairs of stones (PairFinder), in their order;
/// known contacts keep all they carry. What the springs of dropped contacts
/// held is added to `retired`.
void rebuild_pairs(const Particles &particles, const BatchLayout &layout,
                   const std::vector<PairKey> &near, ContactBatch &batch,
                   Dissipation &retired);

/// How far boundaries are looked for: wall_bound plus the margin.
struct WallSearch
{
  BatchLayout layout;
  ContactGeometry geometry = ContactGeometry::ball;
  double margin = 0.; ///< [m]
};

/// Likewise all (stone, plane) within reach, in the order (stone, plane).
void rebuild_planes(const Particles &particles,
                    const std::vector<Plane> &planes, const WallSearch &search,
                    ContactBatch &batch, Dissipation &retired);

/// Likewise the stones near the facet surface and the triangles within reach.
void rebuild_facets(const Particles &particles, const FacetSurface &surface,
                    const WallSearch &search, FacetCandidates &candidates,
                    ContactBatch &batch, Dissipation &retired);

/// Upper bound of the speed at which this stone can close the gap to a body at
/// rest, its turning included [m/s]: (1 + c)|v| + max(L, r)|omega| with L the
/// steepest slope of r and c, for local radii along the branch, the largest
/// L / r_ins of all stones; 0 for balls. Of a true surface no point is faster
/// than |v| + r|omega|.
double closing_speed(const Particles &particles, std::size_t k,
                     double steepness);

/// c above: the largest max_slope / inscribed_radius [-].
double steepness(const Particles &particles);
} // namespace dem
