#pragma once

#include <dem/boundary/facet_contacts.h>

#include <cstdint>
#include <vector>

namespace dem
{
/// The contacts with planes name the particles by their new numbers and stand
/// in the order (particle, plane) again.
void renumber_planes(const std::vector<std::int32_t> &new_row,
                     ContactBatch &batch);

/// The same for the slots at the facet surface; rows of triangles are lost and
/// must be found again.
void renumber_facets(const std::vector<std::int32_t> &new_row,
                     FacetCandidates &candidates, ContactBatch &batch);
/// The same where particles follow their surfaces: contacts of any number per
/// particle, whose contact points go with them.
void renumber_facet_contacts(const std::vector<std::int32_t> &new_row,
                             FacetCandidates &candidates, ContactBatch &batch);
} // namespace dem
