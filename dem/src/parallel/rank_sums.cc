#include <dem/parallel/rank_sums.h>

#include <algorithm>
#include <array>

namespace dem
{
void sum_over_ranks(const Ranks &ranks, std::span<ExactSum> sums,
                    std::span<std::int64_t> counts)
{
  std::vector<std::int64_t> entries;
  entries.reserve(4 * sums.size() + counts.size());
  for (const ExactSum &sum : sums)
    for (const std::int64_t limb : sum.limbs())
      entries.push_back(limb);
  entries.insert(entries.end(), counts.begin(), counts.end());
  ranks.sum(entries);
  std::copy(entries.end() - static_cast<std::ptrdiff_t>(counts.size()),
            entries.end(), counts.begin());
  for (std::size_t k = 0; k < sums.size(); ++k)
  {
    std::array<std::int64_t, 4> limbs;
    std::copy_n(entries.begin() + static_cast<std::ptrdiff_t>(4 * k), 4,
                limbs.begin());
    sums[k] = ExactSum::from_limbs(limbs);
  }
}

ContactPointEvents sum_over_ranks(const Ranks &ranks,
                                  const ContactPointEvents &own)
{
  std::array sums{own.n_scans,  own.n_late,     own.n_jumps, own.n_ended,
                  own.n_merged, own.n_unlisted, own.n_lost};
  ranks.sum(sums);
  return {sums[0], sums[1], sums[2], sums[3], sums[4], sums[5], sums[6]};
}

OverlapRecord largest_over_ranks(const Ranks &ranks, const OverlapRecord &own)
{
  std::array largest{own.recent, own.largest};
  ranks.max(largest);
  return {largest[0], largest[1]};
}

bool any_of_ranks(const Ranks &ranks, bool own)
{
  std::array any{own ? 1. : 0.};
  ranks.max(any);
  return any[0] > 0.;
}
} // namespace dem
