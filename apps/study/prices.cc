#include "study/prices.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace spall
{
namespace
{
/// An error that is below this share of the spread is fine.
constexpr double fine_share = 0.5;

using BySeed = std::map<std::string, double>;

std::size_t cost_place(const Study &study)
{
  return static_cast<std::size_t>(
      std::ranges::find(study.outcomes, study.cost) - study.outcomes.begin());
}

/// Outcome by seed of the cases that are taken.
template <typename Takes>
BySeed outcomes_by_seed(const StudyData &data, std::size_t outcome,
                        const Takes &takes)
{
  BySeed values;
  for (std::size_t p = 0; p < data.points.size(); ++p)
    if (data.results[p].is_done && takes(data.points[p]) &&
        std::isfinite(data.results[p].outcomes[outcome]))
      values[data.points[p].seed] = data.results[p].outcomes[outcome];
  return values;
}

BySeed of_reference(const StudyData &data, std::size_t outcome)
{
  return outcomes_by_seed(
      data, outcome, [](const StudyPoint &point) { return point.is_base; });
}

BySeed of_level(const StudyData &data, std::size_t outcome,
                const PricedLevel &level)
{
  const Cut cut(level.key);
  return outcomes_by_seed(data, outcome,
                          [&](const StudyPoint &point) {
                            return cut.takes(point) &&
                                   point.values[level.key] == level.value;
                          });
}

/// combine(value, reference) of every seed that has both.
template <typename Combined>
std::vector<double> in_pairs(const BySeed &values, const BySeed &reference,
                             const Combined &combine)
{
  std::vector<double> pairs;
  for (const auto &[seed, value] : values)
    if (const auto partner = reference.find(seed); partner != reference.end())
      pairs.push_back(combine(value, partner->second));
  return pairs;
}

/// An error over the spread; infinite where no case gave one: that must not
/// pass for none [-].
double share_of(double error, double spread)
{
  if (!std::isfinite(error))
    return std::numeric_limits<double>::infinity();
  return error == 0. ? 0. : std::abs(error) / spread;
}

PricedLevel price_level(const StudyData &data, std::size_t key,
                        const std::string &value,
                        const std::vector<double> &spread)
{
  PricedLevel level;
  level.key = key;
  level.value = value;
  const std::size_t cost = cost_place(data.study);
  level.cost = estimate_of(in_pairs(of_level(data, cost, level),
                                    of_reference(data, cost),
                                    [](double a, double b) { return a / b; }))
                   .mean;
  for (std::size_t o = 0; o < data.study.outcomes.size(); ++o)
  {
    level.errors.push_back(
        estimate_of(in_pairs(of_level(data, o, level), of_reference(data, o),
                             [](double a, double b) { return a - b; })));
    if (o != cost)
      level.worst =
          std::max(level.worst, share_of(level.errors.back().mean, spread[o]));
  }
  return level;
}

bool is_better(const PricedLevel &a, const PricedLevel &b)
{
  return a.cost <= b.cost && a.worst <= b.worst &&
         (a.cost < b.cost || a.worst < b.worst);
}

void mark_cheapest(std::vector<PricedLevel> &levels)
{
  std::map<std::size_t, PricedLevel *> best;
  for (PricedLevel &level : levels)
    if (level.worst < fine_share && level.cost < 1.)
    {
      PricedLevel *&chosen = best[level.key];
      if (!chosen || level.cost < chosen->cost)
        chosen = &level;
    }
  for (auto &[key, level] : best)
    level->is_cheapest_fine = true;
}
} // namespace

std::vector<double> reference_spread(const StudyData &data)
{
  std::vector<double> spread;
  for (std::size_t o = 0; o < data.study.outcomes.size(); ++o)
  {
    std::vector<double> values;
    for (const auto &[seed, value] : of_reference(data, o))
      values.push_back(value);
    spread.push_back(standard_deviation(values));
  }
  return spread;
}

std::vector<PricedLevel> price_levels(const StudyData &data)
{
  std::vector<PricedLevel> levels;
  if (!data.study.has_reference)
    return levels;
  const std::vector<double> spread = reference_spread(data);
  for (std::size_t k = 0; k < data.study.keys.size(); ++k)
    for (const Level &one : levels_of(data, Cut(k), 0))
      if (std::ranges::none_of(
              data.points, [&](const StudyPoint &point)
              { return point.is_base && point.values[k] == one.value; }))
        levels.push_back(price_level(data, k, one.value, spread));
  for (PricedLevel &level : levels)
    level.is_on_front =
        std::isfinite(level.cost) && std::isfinite(level.worst) &&
        std::ranges::none_of(levels, [&](const PricedLevel &other)
                             { return is_better(other, level); });
  mark_cheapest(levels);
  return levels;
}
} // namespace spall
