#include "triaxial/preparation.h"

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
/// Friction among stones is Preparation/friction until the loading boundaries
/// are there, damping Preparation/local_damping; stones do not break.
constexpr CaseKey deciding[] = {
    {"Specimen", "form"},
    {"Specimen", "side"},
    {"Specimen", "diameter"},
    {"Specimen", "height"},
    {"Specimen", "solid_fraction"},
    {"Specimen", "gradation"},
    {"Specimen", "shapes"},
    {"Specimen", "order"},
    {"Specimen", "seed"},
    {"Specimen", "initial_solid_fraction"},
    {"Preparation", "target"},
    {"Preparation", "pressure"},
    {"Preparation", "porosity"},
    {"Preparation", "friction"},
    {"Preparation", "wall_speed"},
    {"Preparation", "local_damping"},
    {"Preparation", "stress_tolerance"},
    {"Preparation", "unbalanced_ratio"},
    {"Preparation", "max_time"},
    {"Stone", "density"},
    {"Stone", "shear_modulus"},
    {"Stone", "poisson_ratio"},
    {"Stone", "rolling_friction"},
    {"Stone", "normal_damping"},
    {"Stone", "shear_damping"},
    {"Wall", "law"},
    {"Wall", "normal_stiffness"},
    {"Wall", "shear_stiffness"},
    {"Wall", "friction"},
    {"Wall", "rolling_friction"},
    {"Wall", "normal_damping"},
    {"Wall", "shear_damping"},
    {"Contact", "geometry"},
    {"Contact", "wall_geometry"},
    {"Contact", "refresh_tolerance"},
    {"Contact", "friction_limit"},
    // Which stones may break is of the stone, and so is its smallest sphere.
    {"Breakage", "min_diameter"},
    {"Breakage", "inscribed"},
    {"Breakage", "quadrature_rings"},
    {"Breakage", "curvature_floor_ratio"}, // of the contacts' stiffness, too
    {"Boundary", "servo_response_time"},
    {"Time", "step"},
    {"Time", "fixed_step"},
    {"Time", "safety"},
};

constexpr CaseKey later[] = {
    {"Case", "kind"},
    {"Case", "title"},
    {"Material", "file"}, // its values are in their sections
    {"Stone", "friction"},
    {"MembraneContact", "normal_stiffness"},
    {"MembraneContact", "shear_stiffness"},
    {"MembraneContact", "friction"},
    {"MembraneContact", "rolling_friction"},
    {"MembraneContact", "normal_damping"},
    {"MembraneContact", "shear_damping"},
    {"Breakage", "is_active"},
    {"Breakage", "fracture_energy"},
    {"Breakage", "min_ball_radius"},
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
    {"Membrane", "law"},
    {"Membrane", "youngs_modulus"},
    {"Membrane", "poisson_ratio"},
    {"Membrane", "thickness"},
    {"Membrane", "tension"},
    {"Membrane", "wrinkling"},
    {"Membrane", "residual_stiffness"},
    {"Membrane", "density"},
    {"Membrane", "mass_damping"},
    {"Boundary", "lateral"},
    {"Boundary", "elements_per_side"},
    {"Boundary", "elements_around"},
    {"Boundary", "plate_mass"},
    {"Coupling", "exchange"},
    {"Coupling", "stone_steps"},
    {"Coupling", "body_time"},
    {"Coupling", "body_steps"},
    {"Coupling", "relaxation"},
    {"Coupling", "relaxation_factor"},
    {"Coupling", "tolerance"},
    {"Coupling", "max_passes"},
    {"Coupling", "gap_limit"},
    {"Coupling", "ledger_limit"},
    {"Loading", "form"},
    {"Loading", "confining_pressure"},
    {"Loading", "amplitude"},
    {"Loading", "frequency"},
    {"Loading", "cycles"},
    {"Loading", "strain_rate"},
    {"Loading", "final_strain"},
    {"Loading", "consolidation_time"},
    {"CycleJump", "tolerance"},
    {"CycleJump", "first"},
    {"CycleJump", "observed"},
    {"CycleJump", "longest"},
    {"Time", "force_tolerance"},
    {"Time", "energy_tolerance"},
    {"Time", "local_damping"},
    {"Output", "samples_per_cycle"},
    {"Output", "frames_per_cycle"},
    {"Output", "checkpoint_every"},
    {"Output", "surfaces"},
    {"Run", "threads"},
};

bool is(const Parameter &parameter, const char *section, const char *key)
{
  return parameter.section == section && parameter.key == key;
}

bool decides(const Parameter &parameter)
{
  return std::ranges::any_of(deciding, [&](const CaseKey &name)
                             { return is(parameter, name.section, name.key); });
}

/// Of the choices that a case makes, the keys it then has no use for.
bool is_unused(const Case &of, const Parameter &parameter)
{
  const bool is_fixed = of.time.step == StepRule::fixed;
  if (is(parameter, "Time", "fixed_step"))
    return !is_fixed;
  if (is(parameter, "Time", "safety"))
    return is_fixed;
  if (is(parameter, "Breakage", "quadrature_rings"))
    return of.breakage.inscribed == dem::InscribedSphereAt::origin;
  if (is(parameter, "Preparation", "porosity"))
    return of.preparation.target == PreparationTarget::pressure;
  const bool is_box = of.specimen.form == SpecimenForm::box;
  if (is(parameter, "Specimen", "side"))
    return !is_box;
  return is_box && (is(parameter, "Specimen", "diameter") ||
                    is(parameter, "Specimen", "height"));
}

std::string contents_of_gradation(const Case &of)
{
  const Gradation curve = read_gradation(
      find_path(of, "Specimen", "gradation", of.specimen.gradation));
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
} // namespace

std::span<const CaseKey> keys_of_preparation()
{
  return deciding;
}

std::span<const CaseKey> keys_after_preparation()
{
  return later;
}

std::string preparation_text(const Case &parameters, const ShapeLibrary &shapes)
{
  Case of = parameters;
  std::string text =
      "spall " SPALL_VERSION ", layout " + hex_text(state_layout) + "\n";
  for (const Parameter &parameter : parameters_of(of))
  {
    if (!decides(parameter) || is_unused(of, parameter))
      continue;
    std::string value = value_text(parameter);
    if (is(parameter, "Specimen", "gradation"))
      value = contents_of_gradation(parameters);
    else if (is(parameter, "Specimen", "shapes"))
      value = contents_of_shapes(shapes);
    text += parameter.section + "/" + parameter.key + " = " + value + "\n";
  }
  return text;
}
} // namespace spall
