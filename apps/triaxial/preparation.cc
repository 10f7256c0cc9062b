#include "triaxial/preparation.h"

namespace spall
{
namespace
{
/// Of the choices that a case makes, the keys it then has no use for.
std::vector<std::string> unused_keys(const Case &of)
{
  // Until the loading boundaries are there, friction among particles is
  // Preparation/friction.
  std::vector<std::string> keys = {"Particle/friction"};
  if (of.preparation.target == PreparationTarget::pressure)
    keys.push_back("Preparation/porosity");
  if (of.specimen.form == SpecimenForm::box)
    keys.insert(keys.end(), {"Specimen/diameter", "Specimen/height"});
  else
    keys.push_back("Specimen/side");
  return keys;
}
} // namespace

std::string specimen_text(const Case &parameters, const ShapeLibrary &shapes)
{
  const std::string text =
      preparation_text(parameters, shapes, parameters.preparation.safety,
                       unused_keys(parameters));
  // The other boundaries take over from the same rigid sides.
  return parameters.boundary.lateral == Lateral::periodic
             ? text + "Boundary/lateral = periodic\n"
             : text;
}
} // namespace spall
