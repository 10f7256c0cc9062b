#pragma once

#include <dem/contact/batch.h>
#include <dem/contact/lost_energy.h>
#include <dem/neighbor/near_pairs.h>
#include <dem/particles/particle_system.h>

namespace dem
{
/// Makes the batch hold these pairs of particles (PairFinder), nearly in their
/// order: of contacts near each other, those that touch come first. Known
/// contacts keep all they carry. What the springs of dropped contacts held is
/// added to `retired`.
void rebuild_pairs(const ParticleSystem &particles, const BatchLayout &layout,
                   const std::vector<PairKey> &near, ContactBatch &batch,
                   LostEnergy &retired);

/// c of (1 + c)|v| + reach |omega|, the bound of the speed at which a particle
/// can close a gap, where overlap is of local radii along the branch: largest
/// max_slope / least_radius [-].
double steepness(const ParticleSystem &particles);
} // namespace dem
