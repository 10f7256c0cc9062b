#pragma once

#include <dem/boundary/facet_contacts.h>

#include <iosfwd>

namespace dem
{
/// The contact points of a facet surface, bit for bit.
void write_contact_points(std::ostream &out,
                          const FacetContactPoints &contact_points);
/// Throws std::runtime_error if the stream does not fit.
void read_contact_points(std::istream &in, FacetContactPoints &contact_points);
} // namespace dem
