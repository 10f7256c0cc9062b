#pragma once

#include <dem/contact/batch.h>
#include <dem/contact/lost_energy.h>
#include <dem/neighbor/near_pairs.h>
#include <dem/particles/particle_system.h>

#include <vector>

namespace dem
{
/// Makes the batch hold these contacts of particles with a boundary, (particle,
/// row) in rising order as before. Known contacts keep all they carry; what the
/// springs of dropped ones held is added to `retired`. Returns which contact
/// each one was, -1 of new ones.
std::vector<std::int32_t> rebuild_walls(const ParticleSystem &particles,
                                        const std::vector<PairKey> &near,
                                        const BatchLayout &layout,
                                        ContactBatch &batch,
                                        LostEnergy &retired);
} // namespace dem
