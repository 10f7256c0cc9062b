#pragma once

#include <dem/boundary/wall_refinement.h>
#include <dem/neighbor/contact_points.h>

#include <span>
#include <vector>

namespace dem
{
/// A particle in the search for contact points on walls.
struct MappedParticlePose
{
  MappedParticle particle;
  Vec3 position = Vec3::Zero();     ///< [m]
  Mat3 rotation = Mat3::Identity(); ///< body frame to world
};

/// Result of a search for the contact points of a particle and a wall.
struct WallSearchResult
{
  /// Of overlap > -skin, deepest first.
  std::vector<WallContactPoint> contact_points;
  int n_lost = 0; ///< minima of the nodes without a contact point
};

/// Whether two contact points on a wall are one: beside each other on the
/// particle, on one patch of the wall.
bool is_one_contact_point(const WallContactPoint &one,
                          const WallContactPoint &other);

/// All contact points of a particle and a triangulated surface within `skin`
/// [m]: from the nodes of its map that are nearest to the surface
/// among their neighbours, from vertices that are deepest in the particle
/// among theirs, and from the triangles beside every contact point, by
/// refine_on_facets(). Contact points that are one with `known` ones are left
/// out.
WallSearchResult find_on_facets(const MappedParticlePose &particle,
                                const FacetMesh &mesh,
                                std::span<const std::int32_t> triangles,
                                double skin,
                                std::span<const WallContactPoint> known = {});

/// The same on the cylinder or an end of a drum.
WallSearchResult find_on_drum(const MappedParticlePose &particle,
                              const Drum &drum, DrumPart part, double skin,
                              std::span<const WallContactPoint> known = {});
} // namespace dem
