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

/// Makes the batch hold all (particle, part of the drum) within reach; known
/// contacts keep what they carry.
void rebuild_drum(const ParticleSystem &particles, const Drum &drum,
                  const WallSearch &search, ContactBatch &batch,
                  LostEnergy &retired);

/// The drum as the contacts of the batch meet it now: row `b` is the wall of
/// contact k. Rows of touching contacts store their previous positions.
void find_drum(const ParticleSystem &particles, const Drum &drum,
               const ContactBatch &batch, std::vector<WallRow> &rows);

/// Moment of the contacts on the drum about its axis [N m].
double drum_torque(const Drum &drum, const ContactBatch &batch,
                   const std::vector<WallRow> &rows);

/// Sum of the forces of the contacts on the cylinder, each along its outward
/// normal there [N].
double drum_thrust(const ContactBatch &batch, const std::vector<WallRow> &rows);
} // namespace dem
