#pragma once

#include <coupling/network_state.h>

#include <array>
#include <span>
#include <string>
#include <vector>

namespace spall
{
class Triaxial;

using coupling::NetworkState;

/// A column or key of NetworkState: name, `when`, unit.
struct NetworkColumn
{
  const char *name, *unit;
  double NetworkState::*value;

  std::string label(const std::string &when = "") const
  {
    return name + (when.empty() ? "" : "_" + when) + "_" + unit;
  }
};

inline constexpr std::array<NetworkColumn, 16> network_columns = {
    {{"coordination_number", "1", &NetworkState::coordination_number},
     {"mean_contact_force", "N", &NetworkState::mean_contact_force},
     {"strong_contact_share", "1", &NetworkState::strong_share},
     {"force_chain_share", "1", &NetworkState::chain_share},
     {"n_force_chains", "1", &NetworkState::n_chains},
     {"force_chain_length", "1", &NetworkState::chain_length},
     {"fabric_anisotropy", "1", &NetworkState::fabric_anisotropy},
     {"sliding_fraction", "1", &NetworkState::sliding_fraction},
     {"inside_axial_stress", "Pa", &NetworkState::inside_axial_stress},
     {"wall_axial_stress", "Pa", &NetworkState::wall_axial_stress},
     {"inside_lateral_stress", "Pa", &NetworkState::inside_lateral_stress},
     {"wall_lateral_stress", "Pa", &NetworkState::wall_lateral_stress},
     {"specimen_axial_stress", "Pa", &NetworkState::specimen_axial_stress},
     {"specimen_lateral_stress", "Pa", &NetworkState::specimen_lateral_stress},
     {"membrane_axial_stress", "Pa", &NetworkState::membrane_axial_stress},
     {"membrane_lateral_stress", "Pa",
      &NetworkState::membrane_lateral_stress}}};

/// While loading.
NetworkState network_state(const Triaxial &test);

/// coupling::boundary_profile() as a CSV table.
std::string profile_table(const dem::BoundaryProfile &profile);

/// coupling::section_areas() over the share of the height as a CSV table.
std::string sections_table(std::span<const double> areas);
} // namespace spall
