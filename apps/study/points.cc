// The cases of a study: rows of values of its keys, as cases with a seed.
#include "case/fields.h"
#include "errors.h"
#include "study/levels.h"
#include "study/study.h"
#include "study/words.h"

#include <algorithm>
#include <cstdio>

namespace spall
{
namespace
{
using Row = std::vector<std::string>;

/// Values of the swept keys in a case, which is of this variant.
Row values_in(const Study &study, Case parameters, const std::string &variant)
{
  const std::vector<Parameter> list = parameters_of(parameters);
  Row values;
  for (const SweptKey &key : study.keys)
  {
    if (key.is_variant())
    {
      values.push_back(variant);
      continue;
    }
    const auto found = std::ranges::find(list, key.name(), &Parameter::name);
    if (found == list.end())
      throw InputError(key.location + ": Sweep/" + key.name() +
                       ": no parameter of this name");
    values.push_back(same_text(value_text(*found)));
  }
  return values;
}

/// Those of the base case.
Row base_values(const Study &study)
{
  return values_in(study, read_case(study.case_file, study.base), "as_given");
}

/// One row of values per case: each key by itself around the base.
std::vector<Row> single_rows(const Study &study, const Row &base,
                             std::size_t first)
{
  std::vector<Row> rows;
  for (std::size_t k = first; k < study.keys.size(); ++k)
    for (const std::string &value : study.keys[k].values)
    {
      rows.push_back(base);
      rows.back()[k] = same_text(value);
    }
  return rows;
}

/// All combinations.
std::vector<Row> grid_rows(const Study &study)
{
  std::vector<Row> rows(1);
  for (const SweptKey &key : study.keys)
  {
    std::vector<Row> longer;
    for (const Row &row : rows)
      for (const std::string &value : key.values)
      {
        longer.push_back(row);
        longer.back().push_back(same_text(value));
      }
    rows = std::move(longer);
  }
  return rows;
}

std::vector<Row> rows_of(const Study &study, const Row &base)
{
  if (study.combine == Combine::grid)
    return grid_rows(study);
  std::vector<Row> rows;
  if (study.has_reference())
    rows.push_back(base);
  if (study.combine == Combine::each)
    for (const Row &row : single_rows(study, base, 0))
      rows.push_back(row);
  else
    for (const Variant &variant : study.variants)
    {
      Row around = base;
      around[0] = variant.name;
      for (const Row &row : single_rows(study, around, 1))
        rows.push_back(row);
    }
  return rows;
}

/// Whether the row is a point of the sweep of key k: it has one of the values
/// of the key, and the others are those of the base. The variants of
/// each_variant meet in every row.
bool is_swept(const Study &study, const Row &row, const Row &base,
              std::size_t k)
{
  if (study.combine == Combine::grid)
    return true;
  const bool meets = study.combine == Combine::each_variant;
  if (meets && study.keys[k].is_variant())
    return true;
  for (std::size_t other = 0; other < row.size(); ++other)
    if (other != k && row[other] != base[other] &&
        !(meets && study.keys[other].is_variant()))
      return false;
  return std::ranges::any_of(study.keys[k].values, [&](const std::string &value)
                             { return same_text(value) == row[k]; });
}

/// A fault of a case, with the study where it is not one of its settings.
std::string locate_fault(const Study &study, const std::string &fault)
{
  return fault.starts_with(study.file) ? fault : study.file + ": " + fault;
}

/// What a row leaves as it is in the base may be another thing in a variant.
StudyPoint make_point(const Study &study, const Row &row, const Row &base,
                      const std::string &seed, std::size_t number)
{
  StudyPoint point;
  point.values = row;
  point.seed = seed;
  point.overrides = study.base;
  const bool leaves_others = study.combine == Combine::each;
  for (std::size_t k = 0; k < row.size(); ++k)
    if (!study.keys[k].is_variant() && !(leaves_others && row[k] == base[k]))
      point.overrides.push_back({study.keys[k].section, study.keys[k].key,
                                 row[k], study.keys[k].location + ": Sweep"});
  for (const Variant &variant : study.variants)
    if (variant.name == row.front())
      point.overrides.insert(point.overrides.end(), variant.settings.begin(),
                             variant.settings.end());
  if (!seed.empty())
    point.overrides.push_back(parse_override(study.seed_key + "=" + seed,
                                             study.file + ": Study/seeds"));
  point.folder = run_name(number);
  try
  {
    const Case parameters = read_case(study.case_file, point.overrides);
    point.values_in_case = values_in(study, parameters, row.front());
    point.resolved = resolved_case(parameters);
    point.notices = parameters.notices;
  }
  catch (const InputError &error)
  {
    throw InputError(locate_fault(study, error.what()));
  }
  return point;
}

/// A condition of an expectation that no case meets is a slip of the pen.
void check_conditions(const Study &study, const std::vector<StudyPoint> &points)
{
  for (const Expectation &e : study.expectations)
    for (const auto &condition : {std::pair(e.where_key, e.where_value),
                                  std::pair(e.than_key, e.than_value)})
    {
      const std::string &key = condition.first, &value = condition.second;
      if (value.empty())
        continue;
      const std::size_t index = index_of(study, key);
      if (std::ranges::none_of(points, [&](const StudyPoint &point)
                               { return point.values[index] == value; }))
        throw InputError(study.file + ": Expect/" + e.name + ": " + key + "=" +
                         value + ": no case of the study has it");
    }
}
} // namespace

std::vector<std::string> notices_of(const std::vector<StudyPoint> &points)
{
  std::vector<std::string> all;
  for (const StudyPoint &point : points)
    for (const std::string &line : point.notices)
      if (std::ranges::find(all, line) == all.end())
        all.push_back(line);
  return all;
}

std::string run_name(std::size_t number)
{
  char name[40];
  std::snprintf(name, sizeof name, "run_%04zu", number);
  return name;
}

std::vector<StudyPoint> points_of(const Study &study)
{
  std::vector<StudyPoint> points;
  std::vector<std::string> seeds = study.seeds;
  if (seeds.empty())
    seeds.emplace_back();
  const Row base = base_values(study);
  const std::vector<Row> rows = rows_of(study, base);
  for (const Row &row : rows)
    for (const std::string &seed : seeds)
    {
      StudyPoint point = make_point(study, row, base, seed, points.size() + 1);
      auto known =
          std::ranges::find_if(points, [&](const StudyPoint &other)
                               { return other.resolved == point.resolved; });
      if (known == points.end())
        known = points.insert(points.end(), std::move(point));
      known->is_base |= row == base;
      for (std::size_t k = 0; k < row.size(); ++k)
        if (is_swept(study, row, base, k) &&
            std::ranges::find(known->sweeps, static_cast<int>(k)) ==
                known->sweeps.end())
          known->sweeps.push_back(static_cast<int>(k));
    }
  for (const std::string &seed : study.spread_seeds)
  {
    points.push_back(make_point(study, base, base, seed, points.size() + 1));
    points.back().is_base = true; // and of no sweep
  }
  check_conditions(study, points);
  return points;
}
} // namespace spall
