#include "study/study.h"

#include "case/fields.h"
#include "case/source.h"
#include "errors.h"

#include <algorithm>
#include <sstream>

namespace spall
{
namespace
{
[[noreturn]] void refuse(const Assignment &a, const std::string &allowed)
{
  throw InputError(a.place + ": " + a.section + "/" + a.key + " = " + a.value +
                   ": " + allowed);
}

std::vector<std::string> words_of(const std::string &text, char separator)
{
  std::vector<std::string> words;
  std::istringstream in(text);
  for (std::string word; std::getline(in, word, separator);)
  {
    word.erase(0, word.find_first_not_of(" \t"));
    word.erase(word.find_last_not_of(" \t") + 1);
    if (!word.empty())
      words.push_back(word);
  }
  return words;
}

std::vector<std::string> list_of(const Assignment &a)
{
  std::vector<std::string> values = words_of(a.value, ',');
  if (values.empty())
    refuse(a, "must be values with commas between them");
  return values;
}

void take_study(const Assignment &a, Study &study)
{
  if (a.key == "case")
  {
    Case beside;
    beside.file = study.file;
    study.case_file = find_path(beside, "Study", "case", a.value);
  }
  else if (a.key == "title")
    study.title = a.value;
  else if (a.key == "combine")
  {
    if (a.value != "each" && a.value != "grid")
      refuse(a, "must be each (one key at a time) or grid (all combinations)");
    study.is_grid = a.value == "grid";
  }
  else if (a.key == "seeds")
    study.seeds = list_of(a);
  else if (a.key == "outcomes")
    study.outcomes = list_of(a);
  else if (a.key == "curve")
  {
    const std::vector<std::string> columns = list_of(a);
    if (columns.size() != 2)
      refuse(a, "must be two columns of history.csv, x and y");
    study.curve_x = columns[0];
    study.curve_y = columns[1];
  }
  else
    refuse(a, "no key of this name: must be case, title, combine, seeds, "
              "outcomes or curve");
}

void take_sweep(const Assignment &a, Study &study)
{
  const std::size_t slash = a.key.find('/');
  if (slash == std::string::npos)
    refuse(a, "must be Section/key = values");
  study.keys.push_back(
      {a.key.substr(0, slash), a.key.substr(slash + 1), list_of(a), a.place});
}

/// NAME = Section/key=value; Section/key=value ...
void take_variant(const Assignment &a, Study &study)
{
  Variant variant{a.key, {}};
  for (const std::string &setting : words_of(a.value, ';'))
  {
    const std::size_t slash = setting.find('/'), equals = setting.find('=');
    if (slash == std::string::npos || equals == std::string::npos ||
        slash > equals)
      refuse(a, "must be Section/key=value with semicolons between them");
    variant.settings.push_back(parse_override(setting));
  }
  if (study.variants.empty())
    study.keys.insert(study.keys.begin(), {variant_key, "", {}, a.place});
  study.keys.front().values.push_back(variant.name);
  study.variants.push_back(variant);
}

/// OUTCOME RELATION with Section/key.
void take_expectation(const Assignment &a, Study &study)
{
  const std::vector<std::string> words = words_of(a.value, ' ');
  if (words.size() != 4 || words[2] != "with" ||
      std::ranges::find(relations, words[1]) == relations.end())
    refuse(a, "must be OUTCOME rises|falls|changes|stays|settles_low|"
              "settles_high with Section/key");
  study.expectations.push_back({a.key, words[0], words[1], words[3]});
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
    need(std::ranges::any_of(study.keys, [&](const SweptKey &key)
                             { return key.name() == e.key; }),
         "Expect/" + e.name + ": " + e.key + " is not in section Sweep");
  }
}

std::string seed_key_of(CaseKind kind)
{
  switch (kind)
  {
  case CaseKind::single_particle:
    return "Particle/seed";
  case CaseKind::los_angeles:
    return "Charge/seed";
  case CaseKind::subgrade:
    return "Layer/seed";
  case CaseKind::vibratory_compaction:
    return "Filling/seed";
  case CaseKind::dynamic_triaxial:
    break;
  }
  return "Specimen/seed";
}

/// Values of the swept keys in the base case.
std::vector<std::string> base_values(const Study &study)
{
  Case base = read_case(study.case_file, {});
  const std::vector<Parameter> list = parameters_of(base);
  std::vector<std::string> values;
  for (const SweptKey &key : study.keys)
  {
    if (key.is_variant())
    {
      values.emplace_back("as_given");
      continue;
    }
    const auto found = std::ranges::find_if(
        list, [&](const Parameter &p)
        { return p.section == key.section && p.key == key.key; });
    if (found == list.end())
      throw InputError(key.place + ": Sweep/" + key.name() +
                       ": no parameter of this name");
    values.push_back(value_text(*found));
  }
  return values;
}

/// The values of one case per row: all combinations, or each key by itself.
std::vector<std::vector<std::string>> rows_of(const Study &study)
{
  const std::vector<std::string> base = base_values(study);
  std::vector<std::vector<std::string>> rows;
  if (!study.is_grid)
  {
    for (std::size_t k = 0; k < study.keys.size(); ++k)
      for (const std::string &value : study.keys[k].values)
      {
        rows.push_back(base);
        rows.back()[k] = value;
      }
    return rows;
  }
  rows.emplace_back();
  for (const SweptKey &key : study.keys)
  {
    std::vector<std::vector<std::string>> longer;
    for (const std::vector<std::string> &row : rows)
      for (const std::string &value : key.values)
      {
        longer.push_back(row);
        longer.back().push_back(value);
      }
    rows = std::move(longer);
  }
  return rows;
}

/// As the value reads back from a case: 5e8 is 5e+08.
std::string same_text(const std::string &value)
{
  try
  {
    return number_text(to_number(value));
  }
  catch (const std::invalid_argument &)
  {
    return value;
  }
}

StudyPoint make_point(const Study &study, const std::vector<std::string> &row,
                      const std::string &seed, std::size_t number)
{
  StudyPoint point;
  point.seed = seed;
  for (std::size_t k = 0; k < row.size(); ++k)
  {
    point.values.push_back(same_text(row[k]));
    if (!study.keys[k].is_variant())
      point.overrides.push_back(
          {study.keys[k].section, study.keys[k].key, row[k]});
    for (const Variant &variant : study.variants)
      if (study.keys[k].is_variant() && variant.name == row[k])
        point.overrides.insert(point.overrides.end(), variant.settings.begin(),
                               variant.settings.end());
  }
  if (!seed.empty())
    point.overrides.push_back(parse_override(study.seed_key + "=" + seed));
  char name[40];
  std::snprintf(name, sizeof name, "run_%04zu", number);
  point.folder = name;
  try
  {
    point.resolved = resolved_case(read_case(study.case_file, point.overrides));
  }
  catch (const InputError &error)
  {
    throw InputError(study.file + ": " + error.what());
  }
  return point;
}
} // namespace

Study read_study(const std::string &file)
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
      take_expectation(a, study);
    else
      refuse(
          a,
          "no section of this name: must be Study, Sweep, Variants or Expect");
  check_study(study);
  study.seed_key = seed_key_of(read_case(study.case_file, {}).kind);
  return study;
}

std::vector<StudyPoint> points_of(const Study &study)
{
  std::vector<StudyPoint> points;
  std::vector<std::string> seeds = study.seeds;
  if (seeds.empty())
    seeds.emplace_back();
  const std::vector<std::vector<std::string>> rows = rows_of(study);
  for (std::size_t r = 0; r < rows.size(); ++r)
    for (const std::string &seed : seeds)
    {
      StudyPoint point = make_point(study, rows[r], seed, points.size() + 1);
      auto known =
          std::ranges::find_if(points, [&](const StudyPoint &other)
                               { return other.resolved == point.resolved; });
      if (known == points.end())
        known = points.insert(points.end(), std::move(point));
      if (study.is_grid)
        continue;
      // Row r is of the sweep that the first r values reach into.
      std::size_t k = 0;
      for (std::size_t left = r; left >= study.keys[k].values.size(); ++k)
        left -= study.keys[k].values.size();
      known->sweeps.push_back(static_cast<int>(k));
    }
  return points;
}
} // namespace spall
