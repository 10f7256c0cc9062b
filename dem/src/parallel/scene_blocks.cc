#include "scene_blocks.h"

namespace dem
{
SceneBlocks::SceneBlocks(Distribution &distribution,
                         const DistributedParts &own)
    : among(distribution), pairs(own.pairs),
      candidates(own.pair_candidates), named{own.particles, own.work, pairs,
                                             candidates, own.boundaries}
{
  name_partners_by_id(named);
}

void SceneBlocks::take(std::int64_t first, std::int64_t end,
                       const DistributedParts &into)
{
  const std::vector<std::int64_t> &ids = named.particles.id;
  Leaving some;
  for (std::size_t i = 0; i < named.particles.n_owned(); ++i)
    if (ids[i] >= first && ids[i] < end)
      some.add(static_cast<std::int32_t>(i));
  constexpr int first_rank = 0;
  std::vector<Parcel> parcels;
  parcels.push_back(parcel_of(named, first_rank, some, among.series()));
  take_parcels(among.ranks().deliver(std::move(parcels)), among.ranks(), into,
               among.series());
  into.particles.renew_frames();
  sort_by_id(into);
}
} // namespace dem
