#include "study/levels.h"

#include "report/text.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace spall
{
namespace
{
/// Differences of means below this share of the mean of all are none.
constexpr double noticeable = 0.05;

bool read_number(const std::string &text, double &value)
{
  char *end = nullptr;
  value = std::strtod(text.c_str(), &end);
  return !text.empty() && *end == '\0';
}

std::vector<Level> empty_levels(const StudyData &data, std::size_t k)
{
  std::vector<Level> levels;
  bool are_numbers = true;
  for (std::size_t p = 0; p < data.points.size(); ++p)
  {
    const std::string &value = data.points[p].values[k];
    if (!is_in_sweep(data, p, k) ||
        std::ranges::find(levels, value, &Level::value) != levels.end())
      continue;
    Level level{value, 0., {}};
    are_numbers &= read_number(value, level.x);
    levels.push_back(level);
  }
  if (are_numbers)
    std::ranges::sort(levels, {}, &Level::x);
  else
    for (std::size_t l = 0; l < levels.size(); ++l)
      levels[l].x = static_cast<double>(l + 1);
  return levels;
}
} // namespace

double Level::mean() const
{
  return samples.empty() ? std::numeric_limits<double>::quiet_NaN()
                         : std::accumulate(samples.begin(), samples.end(), 0.) /
                               static_cast<double>(samples.size());
}

double Level::deviation() const
{
  if (samples.size() < 2)
    return 0.;
  double sum = 0.;
  for (const double sample : samples)
    sum += std::pow(sample - mean(), 2);
  return std::sqrt(sum / static_cast<double>(samples.size() - 1));
}

bool is_in_sweep(const StudyData &data, std::size_t point, std::size_t k)
{
  const std::vector<int> &sweeps = data.points[point].sweeps;
  return data.study.is_grid ||
         std::ranges::find(sweeps, static_cast<int>(k)) != sweeps.end();
}

std::vector<Level> levels_of(const StudyData &data, std::size_t k,
                             std::size_t outcome)
{
  std::vector<Level> levels = empty_levels(data, k);
  for (std::size_t p = 0; p < data.points.size(); ++p)
    if (is_in_sweep(data, p, k) && data.results[p].is_done)
      if (const double value = data.results[p].outcomes[outcome];
          std::isfinite(value))
        std::ranges::find(levels, data.points[p].values[k], &Level::value)
            ->samples.push_back(value);
  return levels;
}

Verdict judge(const std::vector<Level> &levels, const std::string &relation)
{
  Verdict verdict;
  std::vector<double> means;
  double sum = 0.;
  for (const Level &level : levels)
  {
    verdict.numbers += (verdict.numbers.empty() ? "" : ", ") + level.value +
                       ": " + format(level.mean(), 4);
    if (!std::isfinite(level.mean()))
      return verdict; // some level gave nothing: nothing is shown
    means.push_back(level.mean());
    sum += level.mean();
  }
  if (means.size() < 2)
    return verdict;
  const double limit =
      noticeable * std::abs(sum / static_cast<double>(means.size()));
  const auto [low, high] = std::ranges::minmax(means);
  const bool has_changed = high - low > limit;
  const double sign = relation == "falls" ? -1. : 1.;
  bool is_one_way = sign * (means.back() - means.front()) > limit;
  for (std::size_t l = 1; l < means.size(); ++l)
    is_one_way = is_one_way && sign * (means[l] - means[l - 1]) >= -limit;
  const std::size_t n = means.size();
  if (relation == "rises" || relation == "falls")
    verdict.is_shown = is_one_way;
  else if (relation == "changes")
    verdict.is_shown = has_changed;
  else if (relation == "stays")
    verdict.is_shown = !has_changed;
  else if (relation == "settles_low")
    verdict.is_shown = std::abs(means[1] - means[0]) <= limit;
  else
    verdict.is_shown = std::abs(means[n - 1] - means[n - 2]) <= limit;
  return verdict;
}
} // namespace spall
