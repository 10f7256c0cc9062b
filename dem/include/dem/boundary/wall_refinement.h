#pragma once

#include <dem/boundary/drum.h>
#include <dem/boundary/facet_surface.h>
#include <dem/contact/wall_contact_point.h>

namespace dem
{
/// Refines from a point of the mesh (`triangle`, `weight`, `on_particle` of the
/// start) to the deepest one; where the mesh is concave and a neighbouring
/// triangle holds a deeper contact point within 45 degrees, to that. Triangles
/// are met from their inner side alone.
WallContactPoint refine_on_facets(ParticleView &particle, const FacetMesh &mesh,
                                  const WallContactPoint &start);

/// The deepest contact point of the same patch on the triangles beside a
/// contact point; the contact point itself if none is deeper. Sets its lead.
WallContactPoint deepest_of_patch(ParticleView &particle, const FacetMesh &mesh,
                                  const WallContactPoint &contact_point);

/// The wall at its point next to a point in it, normal towards the particles.
SurfacePoint smooth_drum(const Drum &drum, DrumPart part, const Vec3 &x);

/// The same on the cylinder or an end of a drum.
WallContactPoint refine_on_drum(ParticleView &particle, const Drum &drum,
                                DrumPart part, const WallContactPoint &start);
} // namespace dem
