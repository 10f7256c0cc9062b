#include "run/rank_share.h"

#include <dem/parallel/distribution.h>

#include <array>

namespace spall
{
RankShare rank_share(const dem::Engine &engine)
{
  const dem::Distribution &distribution = engine.distribution();
  const dem::Ranks &ranks = distribution.ranks();
  const auto n_ghosts =
      static_cast<std::int64_t>(distribution.exchange().n_ghosts());
  const auto n_particles =
      static_cast<std::int64_t>(engine.particles().n_owned());
  auto n_contacts = static_cast<std::int64_t>(engine.pairs().n_contacts());
  for (const auto &boundary : engine.boundaries())
    n_contacts += static_cast<std::int64_t>(boundary->batch.n_contacts());
  std::array sums{n_ghosts, n_contacts};
  std::array largest{
      static_cast<double>(n_ghosts), static_cast<double>(n_contacts),
      static_cast<double>(distribution.exchange().bytes_per_step()),
      static_cast<double>(n_particles), -static_cast<double>(n_particles)};
  ranks.sum(sums);
  ranks.max(largest);
  RankShare share;
  share.n_ranks = ranks.size();
  share.mean_ghosts = static_cast<double>(sums[0]) / ranks.size();
  share.most_ghosts = largest[0];
  share.most_bytes = largest[2];
  share.most_particles = largest[3];
  share.fewest_particles = -largest[4];
  if (sums[1] > 0)
    share.imbalance = largest[1] * ranks.size() / static_cast<double>(sums[1]);
  return share;
}
} // namespace spall
