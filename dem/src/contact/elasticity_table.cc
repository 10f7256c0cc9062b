#include <dem/contact/elasticity_table.h>

namespace dem
{
ElasticityTable::ElasticityTable(const EngineParameters &parameters)
{
  std::vector<Elasticity> sides = {
      {parameters.particle.shear_modulus, parameters.particle.poisson_ratio}};
  for (const SolidMaterial &solid : parameters.other_solids)
    sides.push_back({solid.shear_modulus, solid.poisson_ratio});
  n = sides.size();
  for (const Elasticity &a : sides)
  {
    for (const Elasticity &b : sides)
      of_pairs.push_back(mix(a, b));
    of_plates.push_back(mix(a, {0., 0., true}));
  }
}
} // namespace dem
