#pragma once

#include "../contact/force_kernels.h"

#include <cstdint>

/// Contact points on facets as they are followed from step to step, compiled
/// for each instruction set. Plain pointers only: what is inline here would
/// otherwise be linked from the unit with the widest instructions.
namespace dem::kernel
{
/// FacetContactPoint in numbers, and where its fields are.
inline constexpr int facet_point_row = 12, at_weight = 1, at_facet_normal = 4;

/// What the followed contact points of a facet surface are found from, and
/// where they go. Contacts are side A of these columns.
struct FacetTask
{
  const double *particles; ///< ParticleState
  const std::int32_t *a;   ///< by contact, as what follows
  Side side;
  const double *overlap;        ///< of the last step
  const double *overlap_offset; ///< ContactBatch::overlap_offset
  double *points;               ///< FacetContactPoint
  double *reactivation;         ///< FacetContactPoints::reactivation
  double *rows;                 ///< WallRow
  double *depth;                ///< FollowedFacets::overlap

  const double *particle_path; ///< ParticleSystem::path_length
  double surface_path;         ///< FollowedFacets::path_length

  const std::int32_t *corner;               ///< of triangles, three each
  const std::int32_t *neighbour;            ///< FacetTopology::neighbour
  const double *position, *velocity, *mass; ///< of vertices
};

/// An open contact rests if its gap is above this part of the radius: until
/// the paths of particle and surface have closed it.
constexpr double least_resting_gap = 1e-3;

/// Contacts of a block, a bit each.
struct FacetBlock
{
  unsigned is_lost = 0;  ///< the step does not hold: the search must find it
  unsigned is_stale = 0; ///< far from the direction of its expansion
};

/// Follows the `n` contacts from `first`, a block of lane_block at most, to
/// their contact points by one Newton step (docs/theory/surface_walls.md). An
/// expansion is stale `refresh_tolerance` [rad] from its direction.
using FollowFacets = FacetBlock (*)(const FacetTask &task, std::int64_t first,
                                    int n, double refresh_tolerance);

namespace baseline
{
extern const FollowFacets follow_facets;
}
namespace avx2
{
extern const FollowFacets follow_facets;
}
namespace avx512
{
extern const FollowFacets follow_facets;
}
} // namespace dem::kernel
