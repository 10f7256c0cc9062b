#pragma once

#include <coupling/stress_balance.h>

namespace coupling
{
/// Indicators of the contacts of a specimen and its stresses at one instant;
/// see docs/theory/network.md. Plain data.
struct NetworkState
{
  double coordination_number = 0., mean_contact_force = 0.; ///< [-], [N]
  double strong_share = 0.;                                 ///< [-]
  double chain_share = 0., n_chains = 0., chain_length = 0.;
  double fabric_anisotropy = 0., sliding_fraction = 0.;    ///< [-]
  double inside_axial_stress = 0., wall_axial_stress = 0.; ///< [Pa]
  double inside_lateral_stress = 0., wall_lateral_stress = 0.;
  double specimen_axial_stress = 0., specimen_lateral_stress = 0.;
  double membrane_axial_stress = 0., membrane_lateral_stress = 0.;
};

/// Stresses on the walls of a specimen [Pa].
struct WallStress
{
  double axial = 0., lateral = 0.;
};

/// Stress inside is that without a skin of skin_of().
NetworkState network_state(const EnclosedSpecimen &specimen,
                           const StressBalance &balance,
                           const WallStress &on_walls);
} // namespace coupling
