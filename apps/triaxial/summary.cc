#include "run/digest.h"
#include "triaxial/triaxial.h"

#include <dem/engine_boundaries.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>

namespace spall
{
namespace
{
/// Errors are the estimated excess of all jumps together.
void add_jumps(const coupling::JumpAccount &jumps, nlohmann::ordered_json &out)
{
  out["skipped_cycles_1"] = jumps.n_skipped;
  out["n_jumps"] = jumps.n_jumps;
  out["n_refused_jumps"] = jumps.n_refused;
  out["jump_strain_error_1"] = jumps.strain_error;
  out["jump_laa_error_percent"] = jumps.abrasion_error;
}

double void_ratio(double porosity)
{
  return porosity / (1. - porosity);
}

const char *name_of(Lateral lateral)
{
  switch (lateral)
  {
  case Lateral::membrane:
    return "membrane";
  case Lateral::rigid:
    return "rigid";
  case Lateral::periodic:
    return "periodic";
  }
  return "";
}
} // namespace

/// Of the quads of the membrane, those that a particle presses on: a vertex in
/// the middle of each, after the nodes, has a share of every load on it [-].
double Triaxial::pressed_share() const
{
  const auto loads =
      std::span(dem::surface(engine()).load).subspan(membrane()->n_nodes());
  return static_cast<double>(std::ranges::count_if(
             loads, [](const dem::Vec3 &load) { return !load.isZero(0.); })) /
         static_cast<double>(loads.size());
}

/// Strain rate times the mean diameter times sqrt(density / pressure) [-]; its
/// source: GDR MiDi, Eur. Phys. J. E 14 (2004), doi:10.1140/epje/i2003-10153-0.
double Triaxial::inertial_number() const
{
  const dem::ParticleSystem &own = synchronized().particles();
  const auto [diameters, count] =
      dem::sum_particles<2>(engine(),
                            [&own](std::size_t i) {
                              return std::array{2. * own.radius(i), 1.};
                            });
  return parameters.loading.strain_rate * (diameters / count) *
         std::sqrt(parameters.particle.density /
                   parameters.loading.confining_pressure);
}

void Triaxial::summarise(nlohmann::ordered_json &out) const
{
  Test::summarise(out);
  const Sample &start = recorded.loading_start, &end = recorded.last;
  out["n_particles"] = dem::total_particles(synchronized());
  out["lateral"] = name_of(parameters.boundary.lateral);
  out["initial_porosity"] = preparation.porosity;
  if (parameters.time.density_scaling_diameter > 0.)
  {
    out["n_density_scaled"] = scaling.n_scaled;
    out["largest_density_factor_1"] = scaling.largest_factor;
    out["added_mass_1"] = scaling.added_mass;
  }
  if (parameters.time.step == StepRule::error)
  {
    const coupling::StepErrors errors = errors_of(probe);
    out["force_error_1"] = errors.force;
    out["energy_error_1"] = errors.energy;
    out["n_probe_steps"] = probe.n_extra_steps;
  }
  out["cycles_1"] = end.cycle;
  out["peak_axial_stress_Pa"] = recorded.peak_axial_stress;
  const Strength &strength = recorded.strength;
  out["peak_deviatoric_stress_Pa"] = strength.deviator;
  out["axial_strain_at_peak_1"] = strength.strain;
  out["peak_stress_ratio_1"] = strength.stress_ratio;
  out["peak_friction_angle_deg"] =
      strength.friction_angle * 180. / std::numbers::pi;
  if (parameters.loading.form == LoadForm::compression)
    out["inertial_number_1"] = inertial_number();
  out["axial_stress_end_Pa"] = end.axial_stress;
  out["lateral_stress_end_Pa"] = end.lateral_stress;
  out["permanent_axial_strain_1"] = end.axial_strain;
  out["permanent_volumetric_strain_1"] = end.volumetric_strain;
  out["laa_percent"] = end.laa;
  out["porosity_start_1"] = start.porosity;
  out["porosity_end_1"] = end.porosity;
  out["void_ratio_start_1"] = void_ratio(start.porosity);
  out["void_ratio_end_1"] = void_ratio(end.porosity);
  out["coordination_start_1"] = start.coordination_number;
  out["coordination_end_1"] = end.coordination_number;
  out["coordination_change_1"] =
      end.coordination_number - start.coordination_number;
  out["roundness_start_1"] = start.roundness;
  out["roundness_end_1"] = end.roundness;
  out["roundness_change_1"] = end.roundness - start.roundness;
  cycles.add_to(out);
  if (parameters.cycle_jump.is_on())
    add_jumps(plan.account(), out);
  out["external_work_J"] = reported_balance().external_work;
  if (setup.gain)
  {
    out["exchange_gain_1"] = setup.gain->gain;
    if (std::isfinite(setup.gain->limit))
      out["exchange_gain_limit_1"] = setup.gain->limit;
    out["worst_gain_1"] = recorded.worst_gain;
    if (membrane())
    {
      out["n_membrane_quads"] = membrane()->mesh().quads.size();
      out["membrane_pressed_share_1"] = pressed_share();
    }
  }
  const dem::Vec3 &stress = preparation.stress;
  out["preparation"] = {
      {"stress_Pa", {stress.x(), stress.y(), stress.z()}},
      {"unbalanced_force_ratio_1", preparation.unbalanced_ratio},
      {"time_s", preparation.time},
      {"hash", hex_text(preparation.hash)},
      {"is_taken", preparation.is_taken != 0}};
  out["consolidation"] = {
      {"time_s", consolidation.time},
      {"load_error_1",
       std::max(consolidation.load_error, consolidation.motion_error)},
      {"side_stress_error_1", consolidation.side_error},
      {"unbalanced_force_ratio_1", consolidation.unbalanced_ratio}};
}
} // namespace spall
