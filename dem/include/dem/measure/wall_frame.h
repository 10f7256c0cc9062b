#pragma once

#include <dem/measure/network.h>

namespace dem
{
/// wall_contact_point() of a contact of the engine, with the normal from the
/// particle to the boundary; zero where the centre of a sphere lies on a facet.
ContactFrame wall_contact_frame(const Engine &engine, const ContactBatch &batch,
                                std::size_t k);
} // namespace dem
