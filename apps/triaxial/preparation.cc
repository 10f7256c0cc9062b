#include "triaxial/preparation.h"

namespace spall
{
namespace
{
/// Friction among particles is Preparation/friction until the loading
/// boundaries are there, damping Preparation/local_damping.
constexpr CaseKey deciding[] = {
    {"Specimen"}, {"Preparation"}, {"Boundary", "servo_response_time"}};

constexpr CaseKey later[] = {
    {"Particle", "friction"},
    {"Boundary", "lateral"},
    {"Boundary", "mesh"},
    {"Boundary", "elements_per_side"},
    {"Boundary", "elements_around"},
    {"Boundary", "refined"},
    {"Boundary", "servo_yielding"},
    {"Boundary", "servo_dead_band"},
    {"Boundary", "plate_mass"},
    {"Loading"},
    {"CycleJump"},
    {"Output"},
};

/// Of the choices that a case makes, the keys it then has no use for.
bool is_unused(const Case &of, const Parameter &parameter)
{
  if (CaseKey{"Preparation", "porosity"}.names(parameter))
    return of.preparation.target == PreparationTarget::pressure;
  const bool is_box = of.specimen.form == SpecimenForm::box;
  if (CaseKey{"Specimen", "side"}.names(parameter))
    return !is_box;
  return is_box && (CaseKey{"Specimen", "diameter"}.names(parameter) ||
                    CaseKey{"Specimen", "height"}.names(parameter));
}
} // namespace

const PreparationKeys &preparation_keys()
{
  static const PreparationKeys keys(deciding, later);
  return keys;
}

std::string preparation_text(const Case &parameters, const ShapeLibrary &shapes)
{
  return preparation_text(
      parameters, preparation_keys(), shapes, parameters.preparation.safety,
      [&](const Parameter &key) { return is_unused(parameters, key); });
}
} // namespace spall
