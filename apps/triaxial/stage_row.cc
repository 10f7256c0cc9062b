#include "triaxial/stage_row.h"

#include <algorithm>
#include <limits>

namespace spall
{
namespace
{
struct StageColumn
{
  const char *name; ///< name_unit
  double Sample::*value;
};

/// Of the last row of the stage.
constexpr std::array end_columns = {
    StageColumn{"axial_stress_Pa", &Sample::axial_stress},
    StageColumn{"lateral_stress_Pa", &Sample::lateral_stress},
    StageColumn{"axial_target_Pa", &Sample::axial_target},
    StageColumn{"lateral_target_Pa", &Sample::lateral_target},
    StageColumn{"permanent_axial_strain_1", &Sample::axial_strain},
    StageColumn{"permanent_volumetric_strain_1", &Sample::volumetric_strain},
    StageColumn{"laa_percent", &Sample::laa},
    StageColumn{"unbalanced_force_ratio_1", &Sample::unbalanced_force_ratio}};
} // namespace

void LoopMeans::add(const dem::Hysteresis &loop)
{
  const auto k = static_cast<std::size_t>(n) % most;
  stress[k] = loop.cyclic_stress();
  strain[k] = loop.resilient_strain();
  modulus[k] = loop.resilient_modulus();
  damping[k] = loop.damping_ratio();
  ++n;
}

double LoopMeans::mean(const Column &values) const
{
  const auto used = std::min<std::size_t>(static_cast<std::size_t>(n), most);
  double sum = 0.;
  for (std::size_t k = 0; k < used; ++k)
    sum += values[k];
  return used > 0 ? sum / static_cast<double>(used)
                  : std::numeric_limits<double>::quiet_NaN();
}

double LoopMeans::cyclic_stress() const
{
  return mean(stress);
}

double LoopMeans::resilient_strain() const
{
  return mean(strain);
}

double LoopMeans::resilient_modulus() const
{
  return mean(modulus);
}

double LoopMeans::damping_ratio() const
{
  return mean(damping);
}

std::string stages_header()
{
  std::string header = "loading_stage_1,start_time_s,time_s,cycles_1,is_met_1";
  for (const StageColumn &column : end_columns)
  {
    header += ',';
    header += column.name;
  }
  return header + ",cyclic_stress_Pa,resilient_axial_strain_1,"
                  "resilient_modulus_Pa,damping_ratio_1";
}

std::vector<double> stage_values(const LoadFollower &follower,
                                 const Sample &row, double cycles,
                                 const LoopMeans &loops)
{
  const StageRun &run = follower.runs().back();
  std::vector<double> values = {row.loading_stage, run.time, row.time,
                                follower.stage().has_wave() ? cycles : 0.,
                                static_cast<double>(run.is_met)};
  for (const StageColumn &column : end_columns)
    values.push_back(row.*column.value);
  for (const double value : {loops.cyclic_stress(), loops.resilient_strain(),
                             loops.resilient_modulus(), loops.damping_ratio()})
    values.push_back(value);
  return values;
}
} // namespace spall
