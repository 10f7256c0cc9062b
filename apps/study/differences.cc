#include "study/differences.h"

#include "report/text.h"
#include "study/pairs.h"

#include <algorithm>
#include <cmath>

namespace spall
{
std::string reference_value(const StudyData &data, std::size_t key)
{
  const std::vector<Level> levels = levels_of(data, Cut(key), 0);
  const auto most = std::ranges::max_element(
      levels, {}, [](const Level &level) { return level.samples.size(); });
  return most == levels.end() ? "" : most->value;
}

std::string reference_words(const StudyData &data, std::size_t key)
{
  const std::string value = reference_value(data, key);
  const std::vector<Level> levels = levels_of(data, Cut(key), 0);
  return levels.empty() || value == levels.front().value ? "the first value"
                                                         : "the value " + value;
}

std::optional<double> Difference::share() const
{
  constexpr double round_off = 1e-9;
  if (std::abs(reference) <= round_off * std::abs(over_seeds.mean))
    return {};
  return over_seeds.mean / std::abs(reference);
}

std::vector<Difference> differences_of(const StudyData &data, std::size_t key)
{
  std::vector<Difference> all;
  const std::string reference = reference_value(data, key);
  for (std::size_t o = 0; o < data.study.outcomes.size(); ++o)
    for (const Cut &cut : series_of(data, key))
    {
      std::vector<Level> levels = levels_of(data, cut, o);
      if (const auto found =
              std::ranges::find(levels, reference, &Level::value);
          found != levels.end() && !found->samples.empty())
        std::rotate(levels.begin(), found, found + 1);
      for (const Level &level : levels)
      {
        const Level &first = levels.front();
        const bool is_reference = level.value == first.value;
        all.push_back({o, cut, level, is_reference, first.mean(),
                       is_reference
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
