#pragma once

#include <dem/boundary/drum.h>
#include <dem/boundary/wall_candidates.h>
#include <dem/contact/forces.h>
#include <dem/contact/lost_energy.h>

namespace dem
{
/// The part of the drum that contact k of its batch is with; `b` is
/// n_drum_parts times the id of the particle plus the part.
inline DrumPart drum_part(const ContactBatch &batch, std::size_t k)
{
  return static_cast<DrumPart>(batch.b[k] % n_drum_parts);
}

/// `b` of all contacts is the part of the drum alone, in any order of them,
/// until they are numbered again.
void name_by_part(ContactBatch &batch);
/// Contact k, which was contact source[k] (-1: new), gets the row of its number
/// and part, see drum_part().
void number_drum_contacts(const std::vector<std::int32_t> &source,
                          ContactBatch &batch, std::vector<WallRow> &rows);

/// Makes the batch hold all (particle, part of the drum) within reach; known
/// contacts keep what they carry, and their rows.
void rebuild_drum(const ParticleSystem &particles, const Drum &drum,
                  const WallSearch &search, ContactBatch &batch,
                  std::vector<WallRow> &rows, LostEnergy &retired);

/// The drum as the contacts of the batch meet it now: row `b` is the wall of
/// contact k. Rows of touching contacts store their previous positions.
void find_drum(const ParticleSystem &particles, const Drum &drum,
               const ContactBatch &batch, std::vector<WallRow> &rows);

/// Moment of contact k on the drum about its axis [N m].
double torque_on_drum(const Drum &drum, const ContactBatch &batch,
                      std::size_t k, const WallRow &row);

/// Force of contact k on the cylinder along its outward normal there [N].
double thrust_on_drum(const ContactBatch &batch, std::size_t k,
                      const WallRow &row);
} // namespace dem
