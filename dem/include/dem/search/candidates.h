#pragma once

#include <dem/boundary/plane.h>
#include <dem/contact/forces.h>
#include <dem/parameters.h>
#include <dem/particles.h>

namespace dem
{
/// Makes the batch hold all pairs of stones whose gap along the branch is below
/// `margin` [m], in the order (a, b), a < b; known contacts keep all they
/// carry. What dropped contacts had dissipated is added to `retired`.
void rebuild_pairs(const Particles &particles, double margin,
                   ContactBatch &batch, Dissipation &retired);

/// Likewise all (stone, plane) with the plane nearer than the stone's
/// circumscribed sphere plus `margin`, in the order (stone, plane).
void rebuild_planes(const Particles &particles,
                    const std::vector<Plane> &planes, double margin,
                    ContactBatch &batch, Dissipation &retired);

/// Likewise the stones near the facet surface and the triangles that their
/// circumscribed sphere plus `margin` reaches.
void rebuild_facets(const Particles &particles, const FacetSurface &surface,
                    double margin, FacetCandidates &candidates,
                    ContactBatch &batch, Dissipation &retired);

/// Upper bound of the speed at which this stone can close the gap along the
/// branch to a body at rest, its turning included [m/s]:
/// (1 + c)|v| + L |omega| with L the steepest slope of r and c the largest
/// L / r_ins of all stones.
double closing_speed(const Particles &particles, std::size_t k,
                     double steepness);

/// c above: the largest max_slope / inscribed_radius [-].
double steepness(const Particles &particles);
} // namespace dem
