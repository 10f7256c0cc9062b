#pragma once

#include "run/energy_balance.h"

#include <array>

namespace spall
{
/// One row of history.csv; energies since the start of the run.
struct Sample
{
  double time = 0., stage = 0., cycle = 0.;
  double axial_stress = 0., lateral_stress = 0.;
  double membrane_axial_stress = 0., membrane_lateral_stress = 0.;
  double axial_strain = 0., volumetric_strain = 0., porosity = 0.;
  double laa = 0., coordination_number = 0., mean_contact_force = 0.;
  double roundness = 0., n_contacts = 0., n_events = 0.;
  double unbalanced_force_ratio = 0.;
  double external_work = 0., kinetic_energy = 0., elastic_energy = 0.;
  double friction = 0., rolling = 0., damping = 0., breakage = 0.;
  double non_conservative_work = 0., membrane_strain_energy = 0.,
         energy_residual = 0.;
  double overlap_over_radius = 0.; ///< largest since the row before
  double loading_stage = 0.;       ///< of the loading path, from 1; 0: before
  double axial_target = 0., lateral_target = 0.; ///< NaN: a motion
  double x_stress = 0., y_stress = 0.;           ///< on the sides
};

/// Energy balance between two rows.
inline EnergyBalance loading_balance(const Sample &start, const Sample &end)
{
  EnergyBalance balance{end.external_work, end.energy_residual,
                        end.non_conservative_work};
  balance -=
      {start.external_work, start.energy_residual, start.non_conservative_work};
  return balance;
}

/// A column of history.csv.
struct SampleColumn
{
  const char *name; ///< name_unit
  double Sample::*value;
};

inline constexpr std::array<SampleColumn, 33> sample_columns = {
    {{"time_s", &Sample::time},
     {"stage_1", &Sample::stage},
     {"cycle_1", &Sample::cycle},
     {"axial_stress_Pa", &Sample::axial_stress},
     {"lateral_stress_Pa", &Sample::lateral_stress},
     {"axial_strain_1", &Sample::axial_strain},
     {"volumetric_strain_1", &Sample::volumetric_strain},
     {"laa_percent", &Sample::laa},
     {"coordination_number_1", &Sample::coordination_number},
     {"mean_contact_force_N", &Sample::mean_contact_force},
     {"roundness_1", &Sample::roundness},
     {"n_contacts_1", &Sample::n_contacts},
     {"n_events_1", &Sample::n_events},
     {"unbalanced_force_ratio_1", &Sample::unbalanced_force_ratio},
     {"external_work_J", &Sample::external_work},
     {"kinetic_energy_J", &Sample::kinetic_energy},
     {"elastic_energy_J", &Sample::elastic_energy},
     {"friction_dissipation_J", &Sample::friction},
     {"rolling_dissipation_J", &Sample::rolling},
     {"damping_dissipation_J", &Sample::damping},
     {"breakage_energy_J", &Sample::breakage},
     {"non_conservative_work_J", &Sample::non_conservative_work},
     {"membrane_strain_energy_J", &Sample::membrane_strain_energy},
     {"energy_residual_J", &Sample::energy_residual},
     {"membrane_axial_stress_Pa", &Sample::membrane_axial_stress},
     {"membrane_lateral_stress_Pa", &Sample::membrane_lateral_stress},
     {"porosity_1", &Sample::porosity},
     {"overlap_over_radius_1", &Sample::overlap_over_radius},
     {"loading_stage_1", &Sample::loading_stage},
     {"axial_target_Pa", &Sample::axial_target},
     {"lateral_target_Pa", &Sample::lateral_target},
     {"x_stress_Pa", &Sample::x_stress},
     {"y_stress_Pa", &Sample::y_stress}}};
} // namespace spall
