#pragma once

#include <dem/engine.h>

namespace dem
{
/// Indicators of the contact network (theory/network.md); walls are left out.
struct ContactNetwork
{
  std::int64_t n_contacts = 0; ///< C, touching pairs of particles
  double coordination_number =
      0.;                 ///< (2 C - N_1) / (N - N_1 - N_0), Eq. 31 [-]
  double mean_force = 0.; ///< sum |F| / C, Eq. 32 [N]
};

/// Of the contacts of all ranks. Collective.
ContactNetwork contact_network(const Engine &engine);

/// Force of contact k on particle A, the opposite on B, after a step; dashpots
/// to seven digits [N].
Vec3 pair_force(const ParticleSystem &particles, const ContactBatch &pairs,
                std::size_t k);

/// Total volume of the particles of all ranks [m^3]. Collective.
double solid_volume(const ParticleSystem &particles, const Ranks &ranks);

/// LAA = mass lost / initial mass of the particles of all ranks, Eq. 29 [-].
/// Collective.
double abrasion(const ParticleSystem &particles, const Ranks &ranks);

/// Mean |resultant force| on a particle / mean |contact force|, of all ranks
/// [-]; 0 without contacts. Collective.
double unbalanced_force_ratio(const Engine &engine);

/// Stiffness of the packing along x, y, z times its volume, if all particles
/// moved with the mean strain: sum over contacts of (k_n n_i^2 + k_s (1 -
/// n_i^2)) n_i^2 l^2, of all ranks: divided by the volume it is an upper bound
/// of the modulus [N m]. Collective.
Vec3 affine_stiffness(const ParticleSystem &particles,
                      const ContactBatch &pairs, const Ranks &ranks);
} // namespace dem
