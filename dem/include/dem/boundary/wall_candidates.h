#pragma once

#include <dem/boundary/facet_contacts.h>
#include <dem/boundary/plane.h>
#include <dem/contact/forces.h>
#include <dem/contact/lost_energy.h>

namespace dem
{
/// Distance up to which boundaries are searched: wall_bound plus the skin;
/// facets `reach` times wall_bound plus the skin.
struct WallSearch
{
  BatchLayout layout;
  ContactGeometry geometry = geometry_without_shapes;
  double skin = 0.;  ///< [m]
  double reach = 1.; ///< [-]
};

/// Makes the batch hold all (particle, plane) within reach, in the order
/// (particle, plane).
void rebuild_planes(const ParticleSystem &particles,
                    const std::vector<Plane> &planes, const WallSearch &search,
                    ContactBatch &batch, LostEnergy &retired);

/// How near to its centre triangles are taken as candidates of a particle [m].
double facet_reach(const ParticleSystem &particles, std::size_t particle,
                   const WallSearch &search);

/// The particles near the facet surface and the triangles within reach.
FacetCandidates near_facets(const ParticleSystem &particles,
                            const FacetSurface &surface,
                            const WallSearch &search);

/// Makes the candidates hold the particles near the facet surface and the
/// triangles within reach; slots of particles that stay keep what they carry.
void rebuild_facets(const ParticleSystem &particles,
                    const FacetSurface &surface, const WallSearch &search,
                    FacetCandidates &candidates,
                    std::vector<FacetContactPoint> &contact_points,
                    ContactBatch &batch, LostEnergy &retired);
} // namespace dem
