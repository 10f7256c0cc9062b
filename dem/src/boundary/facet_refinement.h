#pragma once

#include <dem/boundary/facet_surface.h>
#include <dem/contact/wall_contact_point.h>

#include <vector>

namespace dem
{
/// Contact points of overlap > -skin on the triangles that share a corner with
/// the triangle of a contact point: in a hollow every face may have its own.
std::vector<WallContactPoint>
contact_points_beside(ParticleView &particle, const FacetMesh &mesh,
                      const WallContactPoint &contact_point, double skin);
} // namespace dem
