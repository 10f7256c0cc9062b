#include "study/study.h"

#include "case/fields.h"
#include "errors.h"
#include "study/levels.h"
#include "study/measured.h"
#include "study/old_names.h"
#include "study/words.h"

#include <algorithm>
#include <charconv>

namespace spall
{
namespace
{
std::vector<std::string> list_of(const Assignment &a)
{
  std::vector<std::string> values = words_of(a.value, ',');
  if (std::ssize(values) != std::ranges::count(a.value, ',') + 1)
    refuse(a, "must be values with commas between them");
  return values;
}

/// Rising whole numbers from 1 up.
std::vector<int> cycles_of(const Assignment &a)
{
  std::vector<int> cycles;
  for (const std::string &text : list_of(a))
  {
    int n = 0;
    const char *end = text.data() + text.size();
    const auto [stop, status] = std::from_chars(text.data(), end, n);
    if (status != std::errc{} || stop != end || n < 1 ||
        (!cycles.empty() && n <= cycles.back()))
      refuse(a, "must be rising whole numbers from 1 up with commas between "
                "them");
    cycles.push_back(n);
  }
  return cycles;
}

/// The enumerator with the position of the value among the names.
template <typename Choice>
Choice choice_of(const Assignment &a, const std::vector<std::string> &names,
                 const std::string &allowed)
{
  const auto found = std::ranges::find(names, a.value);
  if (found == names.end())
    refuse(a, allowed);
  return static_cast<Choice>(found - names.begin());
}

/// FILE: X, Y; FILE: X, Y ...
std::vector<Profile> profiles_of(const Assignment &a)
{
  std::vector<Profile> profiles;
  for (const std::string &text : words_of(a.value, ';'))
  {
    const std::size_t colon = text.find(':');
    const std::vector<std::string> columns =
        words_of(colon == std::string::npos ? "" : text.substr(colon + 1), ',');
    if (colon == 0 || columns.size() != 2)
      refuse(a, "must be FILE: X, Y with semicolons between them, X and Y "
                "columns of a file that every case writes");
    profiles.push_back({text.substr(0, colon), columns[0], columns[1]});
  }
  return profiles;
}

void take_study(const Assignment &a, Study &study)
{
  if (a.key == "case")
  {
    Case beside;
    beside.file = study.file;
    study.case_file = find_path(beside, "Study", "case", a.value);
  }
  else if (a.key == "measured")
  {
    Case beside;
    beside.file = study.file;
    study.measured = find_path(beside, "Study", "measured", a.value);
  }
  else if (a.key == "title")
    study.title = a.value;
  else if (a.key == "combine")
    study.combine = choice_of<Combine>(
        a, {"each", "each_variant", "grid"},
        "must be each (one key at a time), each_variant (that for every "
        "variant) or grid (all combinations)");
  else if (a.key == "judged_by")
    study.judged_by = choice_of<JudgedBy>(
        a, {"means", "seeds"},
        "must be means (5 % of the mean counts) or seeds (what exceeds its "
        "95 % interval over the seeds counts)");
  else if (a.key == "cost")
    study.costs = list_of(a);
  else if (a.key == "controls")
    study.controls = list_of(a);
  else if (a.key == "seeds")
    study.seeds = list_of(a);
  else if (a.key == "spread_seeds")
    study.spread_seeds = list_of(a);
  else if (a.key == "outcomes")
    study.outcomes = list_of(a);
  else if (a.key == "after_cycles")
    study.after_cycles = cycles_of(a);
  else if (a.key == "curve")
  {
    const std::vector<std::string> columns = list_of(a);
    if (columns.size() != 2)
      refuse(a, "must be two columns of history.csv, x and y");
    study.curve_x = columns[0];
    study.curve_y = columns[1];
  }
  else if (a.key == "profiles")
    study.profiles = profiles_of(a);
  else
    refuse(
        a,
        "no key of this name: must be case, title, combine, judged_by, "
        "cost, controls, seeds, spread_seeds, outcomes, after_cycles, curve, "
        "profiles or measured");
}

void take_sweep(const Assignment &a, Study &study)
{
  const std::size_t slash = a.key.rfind('/');
  if (slash == std::string::npos)
    refuse(a, "must be Section/key = values");
  study.keys.push_back({a.key.substr(0, slash),
                        a.key.substr(slash + 1),
                        list_of(a),
                        a.location,
                        {}});
}

void take_base(const Assignment &a, Study &study)
{
  if (a.key != "preset" && a.key.find('/') == std::string::npos)
    refuse(a, "must be Section/key = value or preset = NAME");
  study.base.push_back(parse_override(a.key + "=" + a.value));
}

/// NAME = Section/key=value; Section/key=value ...
void take_variant(const Assignment &a, Study &study)
{
  Variant variant{a.key, {}};
  for (const std::string &setting : words_of(a.value, ';'))
  {
    const std::size_t slash = setting.find('/'), equals = setting.find('=');
    const bool is_preset = setting.starts_with("preset=");
    if (!is_preset && (slash == std::string::npos ||
                       equals == std::string::npos || slash > equals))
      refuse(a, "must be Section/key=value or preset=NAME with semicolons "
                "between them");
    const Override one = parse_override(setting);
    if (std::ranges::find(variant.settings, key_name(one), key_name) !=
        variant.settings.end())
      refuse(a, key_name(one) + " is set twice");
    variant.settings.push_back(one);
  }
  if (study.variants.empty())
    study.keys.insert(study.keys.begin(),
                      {variant_key, "", {}, a.location, {}});
  study.keys.front().values.push_back(variant.name);
  study.variants.push_back(variant);
}

bool is_swept_value(const Study &study, const std::string &key_name,
                    const std::string &value)
{
  const auto key = std::ranges::find(study.keys, key_name, &SweptKey::name);
  return key != study.keys.end() &&
         std::ranges::find(key->values, value, same_text) != key->values.end();
}

void check_study(const Study &study)
{
  const auto need = [&](bool is_there, const std::string &what)
  {
    if (!is_there)
      throw InputError(study.file + ": " + what);
  };
  need(!study.case_file.empty(), "Study/case must name a case file");
  need(!study.keys.empty(), "section Sweep or Variants must have a key");
  need(!study.outcomes.empty(),
       "Study/outcomes must name keys of summary.json");
  for (const Expectation &e : study.expectations)
  {
    need(std::ranges::find(study.outcomes, e.outcome) != study.outcomes.end(),
         "Expect/" + e.name + ": " + e.outcome + " is not in Study/outcomes");
    for (const std::string &name : {e.key, e.than_key, e.where_key})
      need(name.empty() ||
               std::ranges::any_of(study.keys, [&](const SweptKey &key)
                                   { return key.name() == name; }),
           "Expect/" + e.name + ": " + name +
               " is not in section Sweep (or Variants)");
    if (e.course != Course::plain)
      need(is_swept_value(study, e.key, e.course_value),
           "Expect/" + e.name + ": " + e.course_value +
               " is no value of Sweep/" + e.key);
  }
  need(study.combine != Combine::each_variant || !study.variants.empty(),
       "Study/combine = each_variant needs a section Variants");
  for (const Variant &variant : study.variants)
    for (const Override &setting : variant.settings)
      need(
          study.combine == Combine::each ||
              std::ranges::none_of(study.keys, [&](const SweptKey &key)
                                   { return key.name() == key_name(setting); }),
          "Variants/" + variant.name + " and Sweep both set " +
              key_name(setting));
  for (const std::string &control : study.controls)
    need(std::ranges::find(study.variants, control, &Variant::name) !=
             study.variants.end(),
         "Study/controls: " + control + " is not in section Variants");
  need(!study.has_reference() || study.combine == Combine::each,
       "Study/cost needs combine = each");
  need(study.spread_seeds.empty() || study.has_reference(),
       "Study/spread_seeds needs a reference: Study/cost");
  for (const std::string &seed : study.spread_seeds)
    need(std::ranges::find(study.seeds, seed) == study.seeds.end(),
         "Study/spread_seeds: " + seed + " is in Study/seeds already");
}

/// Null if the case has no such key.
const Parameter *find_key(const std::vector<Parameter> &list,
                          const SweptKey &key)
{
  const auto found = std::ranges::find_if(
      list, [&](const Parameter &p)
      { return p.section == key.section && p.key == key.key; });
  return found == list.end() ? nullptr : &*found;
}

/// Kind and units are those of the base case.
void take_base_case(Case base, Study &study)
{
  study.seed_key = find_kind(base.kind)->seed_key;
  const std::vector<Parameter> list = parameters_of(base);
  for (SweptKey &key : study.keys)
  {
    if (!study.seeds.empty() && key.name() == study.seed_key)
      throw InputError(key.location + ": Sweep/" + key.name() +
                       ": Study/seeds sets it already: must be one of them");
    if (const Parameter *parameter = find_key(list, key))
      key.unit = parameter->unit;
  }
}

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
    const Parameter *found = find_key(list, key);
    if (!found)
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

/// A fault of a setting of this study, with its line where it has one.
std::string locate_fault(const Study &study, const std::string &fault)
{
  constexpr std::string_view start = "--set: ";
  if (fault.starts_with(start))
    for (const SweptKey &key : study.keys)
      if (!key.is_variant() && fault.find(key.name() + " = ") == start.size())
        return key.location + ": Sweep: " + fault.substr(start.size());
  return study.file + ": " + fault;
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
      point.overrides.push_back(
          {study.keys[k].section, study.keys[k].key, row[k]});
  for (const Variant &variant : study.variants)
    if (variant.name == row.front())
      point.overrides.insert(point.overrides.end(), variant.settings.begin(),
                             variant.settings.end());
  if (!seed.empty())
    point.overrides.push_back(parse_override(study.seed_key + "=" + seed));
  point.folder = run_name(number);
  try
  {
    const Case parameters = read_case(study.case_file, point.overrides);
    point.values_in_case = values_in(study, parameters, row.front());
    point.resolved = resolved_case(parameters);
  }
  catch (const InputError &error)
  {
    throw InputError(locate_fault(study, error.what()));
  }
  return point;
}
} // namespace

Study read_study(const std::string &file,
                 const std::vector<Override> &overrides)
{
  Study study;
  study.file = file;
  for (const Assignment &a : read_assignments(file))
    if (a.section == "Study")
      take_study(a, study);
    else if (a.section == "Sweep")
      take_sweep(a, study);
    else if (a.section == "Variants")
      take_variant(a, study);
    else if (a.section == "Expect")
      study.expectations.push_back(read_expectation(a));
    else if (a.section == "Base")
      take_base(a, study);
    else
      refuse(a, "no section of this name: must be Study, Base, Sweep, "
                "Variants or Expect");
  for (const std::string &cost : study.costs)
    if (std::ranges::find(study.outcomes, cost) == study.outcomes.end())
      study.outcomes.push_back(cost);
  study.base.insert(study.base.end(), overrides.begin(), overrides.end());
  replace_old_names(study);
  check_study(study);
  check_measured(study);
  const Case base = read_case(study.case_file, study.base);
  study.deprecated.insert(study.deprecated.end(), base.deprecated.begin(),
                          base.deprecated.end());
  take_base_case(base, study);
  return study;
}

std::string run_name(std::size_t number)
{
  char name[40];
  std::snprintf(name, sizeof name, "run_%04zu", number);
  return name;
}

namespace
{
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
