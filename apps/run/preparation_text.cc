#include "run/preparation_text.h"

#include "case/fields.h"
#include "case/file.h"
#include "run/checkpoint.h"
#include "run/digest.h"
#include "specimen/gradation.h"

#include <algorithm>

namespace spall
{
namespace
{
/// Particles do not break yet.
constexpr CaseKey always_deciding[] = {
    {"Particle", "density"},
    {"Particle", "shear_modulus"},
    {"Particle", "poisson_ratio"},
    {"Particle", "rolling_friction"},
    {"Particle", "normal_damping"},
    {"Particle", "shear_damping"},
    {"Wall"},
    {"Contact"},
    // Which particles may break is of the particle, and so is its smallest
    // sphere.
    {"Breakage", "min_diameter"},
    {"Breakage", "inscribed"},
    {"Breakage", "quadrature_rings"},
    {"Breakage", "curvature_floor_ratio"}, // of the contacts' stiffness, too
    {"Time", "step"},
    {"Time", "fixed_step"},
    {"Time", "safety"},
    {"Time", "impact_error"},
};

constexpr CaseKey always_later[] = {
    {"Case"},
    {"Material"}, // its values are in their sections
    {"MembraneContact"},
    {"Breakage", "is_active"},
    {"Breakage", "fracture_energy"},
    {"Breakage", "min_equivalent_radius"},
    {"Breakage", "kernel_floor"},
    {"Breakage", "kernel_scale"},
    {"Breakage", "hysteresis"},
    {"Breakage", "contacts"},
    {"Breakage", "energy"},
    {"Breakage", "curvature"},
    {"Breakage", "share"},
    {"Breakage", "precedence"},
    {"Breakage", "sides"},
    {"Breakage", "closure"},
    {"Breakage", "memory"},
    {"Membrane"},
    {"Coupling"},
    {"Time", "force_tolerance"},
    {"Time", "energy_tolerance"},
    {"Time", "local_damping"},
    {"Time", "allow_unstable_step"},
    {"Run"},
};

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
  if (CaseKey{"Breakage", "quadrature_rings"}.names(parameter))
    return of.breakage.inscribed == dem::InscribedSphereAt::origin;
  if (CaseKey{"Contact", "refresh_tolerance"}.names(parameter) ||
      CaseKey{"Contact", "skin"}.names(parameter))
    return has_own_steps;
  if (CaseKey{"Contact", "overlap_warning"}.names(parameter) ||
      CaseKey{"Contact", "overlap_stop"}.names(parameter))
    return true; // they stop a run, and change nothing
  const bool is_fixed = of.time.step == StepRule::fixed;
  if (parameter.section == "Time")
    return has_own_steps || (parameter.key == "fixed_step" && !is_fixed) ||
           (is_fixed &&
            (parameter.key == "safety" || parameter.key == "impact_error"));
  return parameter.key == "safety" && !has_own_steps;
}
} // namespace

PreparationKeys::PreparationKeys(std::span<const CaseKey> own_deciding,
                                 std::span<const CaseKey> own_later)
    : deciding(std::begin(always_deciding), std::end(always_deciding)),
      later(std::begin(always_later), std::end(always_later))
{
  deciding.insert(deciding.end(), own_deciding.begin(), own_deciding.end());
  later.insert(later.end(), own_later.begin(), own_later.end());
}

bool lists(std::span<const CaseKey> keys, const Parameter &parameter)
{
  return std::ranges::any_of(keys, [&parameter](const CaseKey &key)
                             { return key.names(parameter); });
}

std::string
preparation_text(const Case &parameters, const PreparationKeys &keys,
                 const ShapeLibrary &shapes, double own_safety,
                 const std::function<bool(const Parameter &)> &is_unused)
{
  Case of = parameters;
  std::string text =
      "spall " SPALL_VERSION ", layout " + hex_text(state_layout) + "\n";
  for (const Parameter &parameter : parameters_of(of))
  {
    if (!lists(keys.deciding, parameter) || is_unused(parameter) ||
        has_no_use(of, parameter, own_safety > 0.))
      continue;
    std::string value = value_text(parameter);
    if (parameter.key == "gradation")
      value = contents_of_gradation(of, parameter);
    else if (parameter.key == "shapes")
      value = contents_of_shapes(shapes);
    text += parameter.section + "/" + parameter.key + " = " + value + "\n";
  }
  return text;
}
} // namespace spall
