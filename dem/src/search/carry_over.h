#pragma once

#include <dem/contact/batch.h>
#include <dem/particles.h>

namespace dem
{
/// What the springs of a touching contact hold is lost when it is dropped.
void retire_contact(const ContactBatch &batch, std::size_t k,
                    Dissipation &retired);

/// Marks the corners that the sides know of; what is stored now has counted.
void note_corners(const Particles &particles, ContactBatch &batch);
} // namespace dem
