#include "case/deprecated.h"

#include "case/fields.h"

#include <algorithm>

namespace spall
{
namespace
{
std::string present_section(const std::string &name)
{
  for (const ListedSection &section : sections(Case{}))
    if (std::ranges::find(section.old_names, name) != section.old_names.end())
      return section.name;
  return name;
}

const Parameter *find_parameter(const Assignment &a,
                                const std::vector<Parameter> &list)
{
  for (const Parameter &parameter : list)
    if (parameter.section == a.section &&
        (parameter.key == a.key ||
         std::ranges::find(parameter.old_keys, a.key) !=
             parameter.old_keys.end()))
      return &parameter;
  return nullptr;
}

void note(const Assignment &a, const std::string &what, const std::string &old,
          const std::string &present, std::vector<std::string> &notes)
{
  const std::string line =
      a.location + ": deprecated " + what + " " + old + ": use " + present;
  if (std::ranges::find(notes, line) == notes.end())
    notes.push_back(line);
}
} // namespace

void use_present_names(Assignment &a, const std::vector<Parameter> &list,
                       std::vector<std::string> &notes)
{
  const std::string old_name = a.section + "/" + a.key;
  a.section = present_section(a.section);
  const Parameter *parameter = find_parameter(a, list);
  if (parameter)
    a.key = parameter->key;
  const std::string name = a.section + "/" + a.key;
  if (name != old_name)
    note(a, "key", old_name, name, notes);
  const Choice *choice =
      parameter ? std::get_if<Choice>(&parameter->value) : nullptr;
  if (!choice)
    return;
  const auto old = choice->old_names.find(a.value);
  if (old == choice->old_names.end())
    return;
  note(a, "value", name + " = " + a.value, old->second, notes);
  a.value = old->second;
}
} // namespace spall
