#pragma once

#include <dem/contact/forces.h>

#include <cstdint>
#include <vector>

namespace dem
{
/// Particles along a Z-curve (Morton 1966) through cubes about as large as a
/// particle: order[k] is the particle that comes k-th. Neighbours in space are
/// then neighbours in memory.
std::vector<std::int32_t> space_order(const std::vector<Vec3> &position);

/// What is where after the particles were put in this order: place[order[k]] =
/// k.
std::vector<std::int32_t> places(const std::vector<std::int32_t> &order);

/// The contacts name the particles by their new places and stand in the order
/// (a, b) again, a < b; sides change their roles where they must.
void renumber_pairs(const std::vector<std::int32_t> &place,
                    ContactBatch &batch);
void renumber_planes(const std::vector<std::int32_t> &place,
                     ContactBatch &batch);

/// The same for the slots at the facet surface; rows of triangles are lost and
/// must be found again.
void renumber_facets(const std::vector<std::int32_t> &place,
                     FacetCandidates &candidates, ContactBatch &batch);
/// The same where particles follow their surfaces: contacts of any number per
/// particle, whose rows or contact_points go with them.
void renumber_drum_places(const std::vector<std::int32_t> &place,
                          ContactBatch &batch, std::vector<WallRow> &rows);
void renumber_facet_places(const std::vector<std::int32_t> &place,
                           FacetCandidates &candidates, ContactBatch &batch);
} // namespace dem
