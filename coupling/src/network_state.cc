#include <coupling/network_state.h>
#include <dem/measure/assembly.h>
#include <dem/measure/region_stress.h>

namespace coupling
{
NetworkState network_state(const EnclosedSpecimen &specimen,
                           const StressBalance &balance,
                           const WallStress &on_walls)
{
  const dem::ParticleSystem &particles = specimen.engine.particles();
  const dem::Network network = dem::contact_network_of(specimen.engine);
  const dem::ContactNetwork contacts = dem::contact_network(specimen.engine);
  const dem::Mat3 inside =
      dem::mean_stress(dem::without_skin(space_of(specimen), skin_of(specimen)),
                       particles, network);
  const dem::ForceChains chains = dem::force_chains(particles, network);
  NetworkState state;
  state.coordination_number = contacts.coordination_number;
  state.mean_contact_force = contacts.mean_force;
  state.strong_share = dem::strong_share(network.pairs);
  state.chain_share = chains.share;
  state.n_chains = static_cast<double>(chains.n_chains);
  state.chain_length = chains.mean_length;
  state.fabric_anisotropy =
      dem::fabric_anisotropy(dem::fabric_tensor(network.pairs));
  state.sliding_fraction = dem::sliding_fraction(network.pairs);
  state.inside_axial_stress = axial(inside);
  state.wall_axial_stress = on_walls.axial;
  state.inside_lateral_stress = lateral(inside);
  state.wall_lateral_stress = on_walls.lateral;
  state.specimen_axial_stress = axial(balance.particles);
  state.specimen_lateral_stress = lateral(balance.particles);
  state.membrane_axial_stress = axial(balance.membrane);
  state.membrane_lateral_stress = lateral(balance.membrane);
  return state;
}
} // namespace coupling
