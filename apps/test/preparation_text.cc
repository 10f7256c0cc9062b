#include "test/preparation_text.h"

#include "case/fields.h"
#include "case/file.h"
#include "run/digest.h"
#include "specimen/gradation.h"
#include "test/checkpoint.h"

#include <algorithm>
#include <map>
#include <set>

namespace spall
{
namespace
{
std::string contents_of_gradation(const Case &of, const Parameter &parameter)
{
  const Gradation curve =
      read_gradation(find_path(of, parameter.section, parameter.key,
                               *std::get<std::string *>(parameter.value)));
  Digest digest;
  digest.add(curve.diameter);
  digest.add(curve.passing);
  return hex_text(digest.value());
}

std::string contents_of_shapes(const ShapeLibrary &shapes)
{
  Digest digest;
  for (const auto &shape : shapes)
  {
    digest.add(std::to_string(shape->size()) + " ");
    digest.add(*shape);
  }
  return hex_text(digest.value());
}

/// Of the choices that a case makes, the keys it then has no use for.
bool has_no_use(const Case &of, const Parameter &parameter, bool has_own_steps)
{
  const std::string name = parameter.name();
  if (name == "Breakage/quadrature_rings")
    return of.breakage.inscribed == dem::InscribedSphereAt::origin;
  if (name == "Contact/refresh_tolerance" || name == "Contact/skin")
    return has_own_steps;
  const bool is_fixed = of.time.step == StepRule::fixed;
  if (parameter.section == "Time")
    return has_own_steps || (parameter.key == "fixed_step" && !is_fixed) ||
           (is_fixed &&
            (parameter.key == "safety" || parameter.key == "impact_error"));
  return parameter.key == "safety" && !has_own_steps;
}
/// Sections whose particles are placed, not drawn.
std::set<std::string> placed_sections(Case &of)
{
  std::set<std::string> names;
  for (const Parameter &parameter : parameters_of(of))
    if (parameter.key == "particles" && parameter.is_path &&
        !value_text(parameter).empty())
      names.insert(parameter.section);
  return names;
}
} // namespace

std::string preparation_text(const Case &parameters, const ShapeLibrary &shapes,
                             double own_safety,
                             const std::vector<std::string> &unused)
{
  Case of = parameters;
  std::map<std::string, bool> has_section;
  for (const ListedSection &section : sections(of))
    has_section[section.name] = section.is_of(of.kind);
  const std::set<std::string> placed = placed_sections(of);
  std::string text =
      "spall " SPALL_VERSION ", layout " + hex_text(state_layout) + "\n";
  for (const Parameter &parameter : parameters_of(of))
  {
    if (!has_section[parameter.section] || !parameter.is_of(of.kind) ||
        !parameter.decides_preparation ||
        std::ranges::find(unused, parameter.name()) != unused.end() ||
        has_no_use(of, parameter, own_safety > 0.) ||
        (placed.contains(parameter.section) &&
         (parameter.key == "gradation" || parameter.key == "seed")))
      continue;
    std::string value = value_text(parameter);
    if (parameter.key == "gradation")
      value = contents_of_gradation(of, parameter);
    else if (parameter.key == "shapes")
      value = contents_of_shapes(shapes);
    else if (const auto contents = of.contents.find(parameter.name());
             contents != of.contents.end())
      value = "contents " + hex_text(contents->second);
    text += parameter.name() + " = " + value + "\n";
  }
  return text;
}
} // namespace spall
