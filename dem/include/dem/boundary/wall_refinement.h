#pragma once

#include <dem/boundary/drum.h>
#include <dem/boundary/facet_surface.h>
#include <dem/contact/wall_contact_point.h>

namespace dem
{
/// Refines from a point of the mesh (`triangle`, `weight`, `on_particle` of the
/// start) up to the deepest one of its neighbourhood, without a step down.
/// Triangles are met from their inner side alone.
WallContactPoint refine_on_facets(ParticleView &particle, const FacetMesh &mesh,
                                  const WallContactPoint &start);

/// The wall at its point next to a point in it, normal towards the particles.
SurfacePoint smooth_drum(const Drum &drum, DrumPart part, const Vec3 &x);

/// The same on the cylinder or an end of a drum.
WallContactPoint refine_on_drum(ParticleView &particle, const Drum &drum,
                                DrumPart part, const WallContactPoint &start);
} // namespace dem
