#include "study/differences.h"

#include "report/text.h"
#include "study/pairs.h"

#include <cmath>

namespace spall
{
std::optional<double> Difference::share() const
{
  constexpr double round_off = 1e-9;
  if (std::abs(first) <= round_off * std::abs(over_seeds.mean))
    return {};
  return over_seeds.mean / std::abs(first);
}

std::vector<Difference> differences_of(const StudyData &data, std::size_t key)
{
  std::vector<Difference> all;
  for (std::size_t o = 0; o < data.study.outcomes.size(); ++o)
    for (const Cut &cut : series_of(data, key))
    {
      const std::vector<Level> levels = levels_of(data, cut, o);
      for (const Level &level : levels)
      {
        const Level &first = levels.front();
        const bool is_first = level.value == first.value;
        all.push_back({o, cut, level, is_first, first.mean(),
                       is_first
                           ? Estimate()
                           : estimate_of(paired_differences(
                                 data, cut, o, first.value, level.value))});
      }
    }
  return all;
}

std::string with_sign(double share)
{
  return (share > 0. ? "+" : "") + format(100. * share, 2) + " %";
}
} // namespace spall
