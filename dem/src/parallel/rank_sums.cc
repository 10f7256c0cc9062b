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

bool any_of_ranks(const Ranks &ranks, bool own)
{
  std::array any{own ? 1. : 0.};
  ranks.max(any);
  return any[0] > 0.;
}
} // namespace dem
