#pragma once

#include "triaxial/triaxial.h"

#include <dem/measure/boundary_profile.h>

#include <array>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace spall
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

/// While loading. Stress inside is that without a skin of skin_of().
NetworkState network_state(const Triaxial &test);

/// The space between the rigid walls, or where the membrane was put, between
/// base and plate now.
dem::Prism space_of(const Triaxial &test);

/// Thickness of what counts as near a boundary: the largest particle, at most a
/// quarter of the least width of the space [m].
double skin_of(const Triaxial &test);

/// Porosity and coordination number over the distance from the boundaries.
dem::BoundaryProfile boundary_profile(const Triaxial &test);

/// The same as a CSV file. Throws RunFailure.
void write_profile(const std::filesystem::path &path,
                   const dem::BoundaryProfile &profile);

/// Areas of horizontal sections at equal distances from base to plate [m^2].
std::vector<double> section_areas(const Triaxial &test);

/// The same over the share of the height as a CSV file. Throws RunFailure.
void write_sections(const std::filesystem::path &path,
                    std::span<const double> areas);
} // namespace spall
