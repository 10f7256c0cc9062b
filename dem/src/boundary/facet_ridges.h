#pragma once

#include <dem/boundary/followed_walls.h>

/// Contact points of one particle on one smooth patch of facets between which
/// the particle reaches into the surface (docs/theory/surface_walls.md).
namespace dem
{
/// What contacts have in common counts once: their energies less that of the
/// ridge between them. Notes it, and takes its force off their overlaps.
void share_ridges(const ForceContext &context, const FollowedFacets &walls,
                  const ContactBatch &batch);

/// Contact k, which has been found again alone, keeps what it has in common.
void keep_shares(const FollowedFacets &walls, const ContactBatch &batch,
                 std::size_t k);
} // namespace dem
