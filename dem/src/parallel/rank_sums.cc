#include <dem/parallel/rank_sums.h>

#include <algorithm>

namespace dem
{
void sum_over_ranks(const Ranks &ranks, std::span<ExactSum> sums)
{
  std::vector<std::int64_t> entries;
  entries.reserve(4 * sums.size());
  for (const ExactSum &sum : sums)
    for (const std::int64_t limb : sum.limbs())
      entries.push_back(limb);
  ranks.sum(entries);
  for (std::size_t k = 0; k < sums.size(); ++k)
  {
    std::array<std::int64_t, 4> limbs;
    std::copy_n(entries.begin() + static_cast<std::ptrdiff_t>(4 * k), 4,
                limbs.begin());
    sums[k] = ExactSum::from_limbs(limbs);
  }
}
} // namespace dem
