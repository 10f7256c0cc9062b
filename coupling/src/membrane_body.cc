#include <coupling/membrane_body.h>

#include <limits>

namespace coupling
{
std::vector<double> movable_mass(const fem::Membrane &membrane)
{
  std::vector<double> mass(membrane.nodal_mass().begin(),
                           membrane.nodal_mass().end());
  for (std::size_t k = 0; k < mass.size(); ++k)
    if (mass[k] == 0. || membrane.is_tied(static_cast<std::int32_t>(k)))
      mass[k] = std::numeric_limits<double>::infinity();
  return mass;
}

BodyEnergy energy_of(const fem::MembraneEnergy &energy)
{
  return {energy.strain, energy.kinetic, energy.damping,
          energy.pressure_work + energy.tie_work, energy.contact_work};
}
} // namespace coupling
