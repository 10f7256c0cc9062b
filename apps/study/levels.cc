#include "study/levels.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace spall
{
namespace
{
bool read_number(const std::string &text, double &value)
{
  char *end = nullptr;
  value = std::strtod(text.c_str(), &end);
  return !text.empty() && *end == '\0';
}

std::vector<Level> empty_levels(const StudyData &data, const Cut &cut)
{
  std::vector<Level> levels;
  bool are_numbers = true;
  for (const StudyPoint &point : data.points)
  {
    const std::string &value = point.values[cut.key];
    if (!cut.takes(point) ||
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
  return estimate_of(samples).mean;
}

double Level::deviation() const
{
  return standard_deviation(samples);
}

bool Cut::takes(const StudyPoint &point) const
{
  return std::ranges::find(point.sweeps, static_cast<int>(key)) !=
             point.sweeps.end() &&
         (!where_key || point.values[*where_key] == where_value);
}

std::vector<Cut> series_of(const StudyData &data, std::size_t key)
{
  const Study &study = data.study;
  const bool is_by_variant = study.combine == Combine::each_variant &&
                             !study.variants.empty() &&
                             !study.keys[key].is_variant();
  const bool is_of_two =
      study.combine == Combine::grid && study.keys.size() == 2;
  if (!is_by_variant && !is_of_two)
    return {Cut(key)};
  const std::size_t other = is_by_variant ? 0 : 1 - key;
  std::vector<Cut> series;
  for (const Level &level : levels_of(data, Cut(other), 0))
  {
    Cut cut(key);
    cut.where_key = other;
    cut.where_value = level.value;
    series.push_back(cut);
  }
  return series;
}

std::size_t index_of(const Study &study, const std::string &key_name)
{
  const auto found = std::ranges::find(study.keys, key_name, &SweptKey::name);
  if (found == study.keys.end())
    throw std::logic_error("no swept key " + key_name);
  return static_cast<std::size_t>(found - study.keys.begin());
}

bool is_beside_base(const StudyData &data, std::size_t key,
                    const StudyPoint &point)
{
  const auto base = std::ranges::find_if(data.points, &StudyPoint::is_base);
  if (base == data.points.end())
    return true;
  for (std::size_t k = 0; k < point.values.size(); ++k)
    if (k != key && point.values[k] != base->values[k])
      return false;
  return true;
}

std::vector<std::size_t> drawn_cases(const StudyData &data, std::size_t key,
                                     const std::string &value)
{
  std::vector<std::size_t> indices;
  for (std::size_t p = 0; p < data.points.size(); ++p)
    if (data.points[p].values[key] == value && data.results[p].is_done &&
        Cut(key).takes(data.points[p]) &&
        (data.study.combine != Combine::grid ||
         is_beside_base(data, key, data.points[p])))
      indices.push_back(p);
  return indices;
}

std::vector<Level> levels_of(const StudyData &data, const Cut &cut,
                             std::size_t outcome)
{
  std::vector<Level> levels = empty_levels(data, cut);
  for (std::size_t p = 0; p < data.points.size(); ++p)
    if (cut.takes(data.points[p]) && data.results[p].is_done)
      if (const double value = data.results[p].outcomes[outcome];
          std::isfinite(value))
        std::ranges::find(levels, data.points[p].values[cut.key], &Level::value)
            ->samples.push_back(value);
  return levels;
}
} // namespace spall
