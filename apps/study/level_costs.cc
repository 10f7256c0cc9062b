#include "study/level_costs.h"

#include "case/fields.h"
#include "study/words.h"

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

std::size_t index_of_outcome(const Study &study, const std::string &outcome)
{
  return static_cast<std::size_t>(std::ranges::find(study.outcomes, outcome) -
                                  study.outcomes.begin());
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
                const LevelCost &level)
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

std::string parameter_of(const Study &study, const LevelCost &level)
{
  const SweptKey &key = study.keys[level.key];
  if (!key.is_variant())
    return key.name();
  const Variant &variant =
      *std::ranges::find(study.variants, level.value, &Variant::name);
  return variant.settings.empty() ? "" : key_name(variant.settings.front());
}

LevelCost level_cost(const StudyData &data, std::size_t key,
                     const std::string &value,
                     const std::vector<double> &spread)
{
  const Study &study = data.study;
  LevelCost level;
  level.key = key;
  level.value = value;
  level.parameter = parameter_of(study, level);
  level.is_control =
      study.keys[key].is_variant() &&
      std::ranges::find(study.controls, value) != study.controls.end();
  for (const std::string &cost : study.costs)
  {
    const std::size_t o = index_of_outcome(study, cost);
    const Estimate ratio =
        estimate_of(in_pairs(of_level(data, o, level), of_reference(data, o),
                             [](double a, double b) { return a / b; }));
    if (level.costs.empty())
      level.saves = ratio.is_below(1.);
    level.costs.push_back(ratio.mean);
  }
  for (std::size_t o = 0; o < study.outcomes.size(); ++o)
  {
    level.errors.push_back(
        estimate_of(in_pairs(of_level(data, o, level), of_reference(data, o),
                             [](double a, double b) { return a - b; })));
    if (!is_cost(study, study.outcomes[o]))
      level.worst =
          std::max(level.worst, share_of(level.errors.back().mean, spread[o]));
  }
  return level;
}

/// Whether the one costs less than the other (the reference if there is none)
/// by its 95 % interval.
bool saves_over(const StudyData &data, const LevelCost &one,
                const LevelCost *other)
{
  const std::size_t o = index_of_outcome(data.study, data.study.costs.front());
  return estimate_of(
             in_pairs(of_level(data, o, one),
                      other ? of_level(data, o, *other) : of_reference(data, o),
                      [](double a, double b) { return a / b; }))
      .is_below(1.);
}

bool is_better(const LevelCost &a, const LevelCost &b)
{
  return !a.is_control && a.cost() <= b.cost() && a.worst <= b.worst &&
         (a.cost() < b.cost() || a.worst < b.worst);
}

void mark_cheapest(std::vector<LevelCost> &levels)
{
  std::map<std::string, LevelCost *> best;
  for (LevelCost &level : levels)
    if (!level.is_control && level.worst < fine_share && level.saves)
    {
      LevelCost *&chosen = best[level.parameter];
      if (!chosen || level.cost() < chosen->cost())
        chosen = &level;
    }
  for (auto &[parameter, level] : best)
    level->is_cheapest_fine = true;
}

/// What a case has for this Section/key; empty if it has no such key.
std::string value_in(Case of, const std::string &name)
{
  for (const Parameter &parameter : parameters_of(of))
    if (parameter.section + "/" + parameter.key == name)
      return same_text(value_text(parameter));
  return "";
}

/// A Section/key and the value that it has, as texts are compared.
using Setting = std::pair<std::string, std::string>;

/// What the level sets: its parameter, or all that its variant does.
std::vector<Setting> settings_of(const Study &study, const LevelCost &level)
{
  if (!study.keys[level.key].is_variant())
    return {{level.parameter, level.value}};
  std::vector<Setting> settings;
  for (const Override &one :
       std::ranges::find(study.variants, level.value, &Variant::name)->settings)
    settings.emplace_back(key_name(one), same_text(one.value));
  return settings;
}

/// Whether the level leaves nothing but defaults.
bool is_default(const Study &study, const LevelCost &level,
                const Case &defaults)
{
  return std::ranges::all_of(
      settings_of(study, level), [&](const Setting &setting)
      { return setting.second == value_in(defaults, setting.first); });
}

/// Whether the level has the default of its own parameter, whatever else it
/// sets.
bool keeps_parameter(const Study &study, const LevelCost &level,
                     const Case &defaults)
{
  const Setting usual{level.parameter, value_in(defaults, level.parameter)};
  return std::ranges::count(settings_of(study, level), usual) > 0;
}
} // namespace

bool is_cost(const Study &study, const std::string &outcome)
{
  return std::ranges::find(study.costs, outcome) != study.costs.end();
}

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

std::ptrdiff_t reference_size(const StudyData &data)
{
  std::ptrdiff_t n = 0;
  for (std::size_t p = 0; p < data.points.size(); ++p)
    n += data.points[p].is_base && data.results[p].is_done;
  return n;
}

std::vector<LevelCost> level_costs(const StudyData &data)
{
  std::vector<LevelCost> levels;
  if (!data.study.has_reference())
    return levels;
  const std::vector<double> spread = reference_spread(data);
  for (std::size_t k = 0; k < data.study.keys.size(); ++k)
    for (const Level &one : levels_of(data, Cut(k), 0))
      if (std::ranges::none_of(
              data.points, [&](const StudyPoint &point)
              { return point.is_base && point.values[k] == one.value; }))
        levels.push_back(level_cost(data, k, one.value, spread));
  for (LevelCost &level : levels)
    level.is_on_front =
        !level.is_control && std::isfinite(level.cost()) &&
        std::isfinite(level.worst) &&
        std::ranges::none_of(levels, [&](const LevelCost &other)
                             { return is_better(other, level); });
  mark_cheapest(levels);
  return levels;
}

std::vector<DefaultCost> default_costs(const StudyData &data,
                                       const std::vector<LevelCost> &map)
{
  const Case reference = read_case(data.study.case_file, data.study.base);
  const Case defaults = template_defaults(reference.kind);
  std::vector<DefaultCost> prices;
  for (const LevelCost &level : map)
  {
    const std::string value = value_in(defaults, level.parameter);
    if (level.is_control || value.empty() ||
        std::ranges::find(prices, level.parameter, &DefaultCost::parameter) !=
            prices.end())
      continue;
    DefaultCost price;
    price.parameter = level.parameter;
    price.default_value = value;
    const bool is_reference = value == value_in(reference, level.parameter);
    if (!is_reference)
      price.cost = price.worst = std::numeric_limits<double>::quiet_NaN();
    const LevelCost *cheapest = nullptr, *usual = nullptr;
    for (const LevelCost &other : map)
    {
      if (other.parameter != level.parameter || other.is_control)
        continue;
      if (is_default(data.study, other, defaults))
        usual = &other;
      if (other.is_cheapest_fine)
        cheapest = &other;
    }
    if (usual)
    {
      price.cost = usual->cost();
      price.worst = usual->worst;
    }
    if (cheapest)
      price.cheapest = cheapest->value;
    price.is_right =
        price.worst < fine_share &&
        (!cheapest || keeps_parameter(data.study, *cheapest, defaults) ||
         !saves_over(data, *cheapest, usual));
    prices.push_back(price);
  }
  return prices;
}
} // namespace spall
