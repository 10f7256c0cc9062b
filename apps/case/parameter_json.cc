#include "case/parameter_json.h"

#include "case/fields.h"
#include "case/file.h"
#include "case/overloaded.h"

#include <nlohmann/json.hpp>

#include <array>
#include <cmath>

namespace spall
{
namespace
{
using Json = nlohmann::ordered_json;

Json value_json(const Parameter &parameter)
{
  return std::visit(
      Overloaded{[](const dem::Vec3 *value) {
                   return Json{value->x(), value->y(), value->z()};
                 },
                 [](const Choice &choice)
                 { return Json(choice.names[choice.get()]); },
                 [](const auto *value) { return Json(*value); }},
      parameter.value);
}

std::string type_name(const Parameter &parameter)
{
  if (parameter.is_path)
    return "path";
  constexpr std::array names = {"number", "integer", "boolean",
                                "text",   "vector",  "choice"};
  return names[parameter.value.index()];
}

void add_range(const Range &range, Json &entry)
{
  if (std::isfinite(range.lower))
  {
    entry["lower"] = range.lower;
    entry["is_lower_open"] = range.is_lower_open;
  }
  if (std::isfinite(range.upper))
  {
    entry["upper"] = range.upper;
    entry["is_upper_open"] = range.is_upper_open;
  }
}

Json entry_json(const Parameter &parameter, const Parameter &by_default)
{
  Json entry = {
      {"key", parameter.key},           {"type", type_name(parameter)},
      {"unit", parameter.unit},         {"default", value_json(by_default)},
      {"value", value_json(parameter)}, {"allowed", allowed(parameter)},
      {"sentence", parameter.sentence}, {"may_change", parameter.may_change}};
  add_range(parameter.range, entry);
  if (!usual(parameter).empty())
  {
    entry["usual_lower"] = parameter.usual.lower;
    entry["usual_upper"] = parameter.usual.upper;
  }
  if (const auto *choice = std::get_if<Choice>(&parameter.value))
    entry["names"] = choice->names;
  if (!parameter.old_keys.empty())
    entry["old_names"] = parameter.old_keys;
  return entry;
}

} // namespace

std::string parameter_json(Case of)
{
  Case defaults = defaults_of(of);
  const std::vector<Parameter> list = parameters_of(of),
                               by_default = parameters_of(defaults);
  Json all = {{"kind", of.kind},
              {"seed_key", find_kind(of.kind)->seed_key},
              {"notices", of.notices},
              {"sections", Json::array()}};
  for (const ListedSection &section : sections(of))
  {
    if (!section.is_of(of.kind))
      continue;
    Json entries = Json::array();
    for (std::size_t k = 0; k < list.size(); ++k)
      if (list[k].section == section.name && list[k].is_of(of.kind))
        entries.push_back(entry_json(list[k], by_default[k]));
    Json one = {{"name", section.name}, {"sentence", section.sentence}};
    if (!section.old_names.empty())
      one["old_names"] = section.old_names;
    one["parameters"] = std::move(entries);
    all["sections"].push_back(std::move(one));
  }
  return all.dump(1) + "\n";
}

std::string template_json(const std::string &kind)
{
  Case shown = template_defaults(kind);
  shown.walls.emplace_back().name = "NAME"; // stands for any
  return parameter_json(std::move(shown));
}
} // namespace spall
