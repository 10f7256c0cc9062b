#pragma once

#include <dem/engine.h>

namespace spall
{
/// How the particles are spread over ranks.
struct RankShare
{
  int n_ranks = 1;
  double fewest_particles = 0., most_particles = 0.; ///< of a rank, owned
  double mean_ghosts = 0., most_ghosts = 0.;         ///< of a rank
  double most_bytes = 0.; ///< sent and received by a rank in a step
  double imbalance = 1.;  ///< most listed contacts of a rank over the mean [-]
};

/// Collective.
RankShare rank_share(const dem::Engine &engine);
} // namespace spall
