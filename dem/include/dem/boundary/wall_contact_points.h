#pragma once

#include <dem/boundary/wall_refinement.h>
#include <dem/neighbor/contact_points.h>

#include <span>
#include <vector>

namespace dem
{
/// A particle as the search for places on walls sees it.
struct MappedParticlePose
{
  MappedParticle particle;
  Vec3 position = Vec3::Zero();     ///< [m]
  Mat3 rotation = Mat3::Identity(); ///< body frame to world
};

/// What a search for the places where a particle meets a wall has found.
struct WallSearchResult
{
  std::vector<WallContactPoint> places; ///< overlap > -skin, deepest first
  int n_lost = 0; ///< minima of the nodes that led to no place
};

/// Whether two places on a wall are one: beside each other on the particle, on
/// one patch of the wall.
bool is_one_place(const WallContactPoint &one, const WallContactPoint &other);

/// All places where a particle meets a triangulated surface or comes within
/// `skin` [m]: from the nodes of its map that are nearest to the surface
/// among their neighbours, and from vertices that are deepest in the particle
/// among theirs, by refine_on_facets(). Only these triangles are looked at.
/// Places beside `known` ones are left out.
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
