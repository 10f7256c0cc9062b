#include "study/study.h"

#include "case/fields.h"
#include "errors.h"
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
  study.base.push_back(
      parse_override(a.key + "=" + a.value, a.location + ": Base"));
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
    const Override one =
        parse_override(setting, a.location + ": Variants/" + variant.name);
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

bool is_set_by_variants(const Study &study, const std::string &key)
{
  return std::ranges::any_of(study.variants,
                             [&](const Variant &variant)
                             {
                               return std::ranges::find(variant.settings, key,
                                                        key_name) !=
                                      variant.settings.end();
                             });
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
               std::ranges::find(study.keys, name, &SweptKey::name) !=
                   study.keys.end(),
           "Expect/" + e.name + ": " + name +
               (is_set_by_variants(study, name)
                    ? " is set by variants: must be Variants, with which all "
                      "that they set changes"
                    : " is not in section Sweep (or Variants)"));
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

/// What was asked on the command line, the last `n` settings of the base, must
/// reach the cases: the study itself sets some keys afterwards.
void check_overrides(const Study &study, std::size_t n)
{
  const auto sets =
      [](const std::vector<Override> &settings, const std::string &name)
  { return std::ranges::find(settings, name, key_name) != settings.end(); };
  const auto refuse = [](const std::string &name, const std::string &why)
  {
    throw InputError("--set " + name + ": " + why +
                     ": must be a key that the study does not set itself");
  };
  for (std::size_t k = study.base.size() - n; k < study.base.size(); ++k)
  {
    const std::string name = key_name(study.base[k]);
    if (!study.seeds.empty() && name == study.seed_key)
      refuse(name, "Study/seeds sets it");
    if (study.combine == Combine::each)
      continue; // the base case has it
    if (std::ranges::find(study.keys, name, &SweptKey::name) !=
        study.keys.end())
      refuse(name, "is in section Sweep");
    for (const Variant &variant : study.variants)
      if (sets(variant.settings, name))
        refuse(name, "Variants/" + variant.name + " sets it");
  }
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
    if (const auto found =
            std::ranges::find(list, key.name(), &Parameter::name);
        found != list.end())
      key.unit = found->unit;
  }
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
  check_overrides(study, overrides.size());
  return study;
}
} // namespace spall
