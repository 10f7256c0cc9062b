#include "triaxial/summary.h"

#include "run/contact_places.h"
#include "run/cost.h"
#include "run/digest.h"
#include "run/ledger_rows.h"

#include <dem/engine_boundaries.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <span>

namespace spall
{
std::map<std::string, double>
wall_clock(const Triaxial &test, const RecordedTime &recorded,
           const std::map<std::string, double> &before)
{
  const dem::EngineClock now = test.engine().clock(),
                         then = recorded.preparation_clock;
  std::map<std::string, double> seconds;
  seconds["preparation"] = recorded.preparation;
  seconds["contacts"] = now.contacts - then.contacts;
  seconds["search"] = now.search - then.search;
  seconds["breakage"] = now.breakage - then.breakage;
  seconds["motion"] = now.motion - then.motion;
  const coupling::ExchangeClock exchange =
      test.exchange() ? test.exchange()->clock() : coupling::ExchangeClock{};
  seconds["membrane"] = exchange.bodies;
  seconds["transfer"] = exchange.transfer;
  seconds["repeating"] = exchange.keeping;
  seconds["guards"] = exchange.guards;
  seconds["step_watch"] = test.watch_seconds();
  seconds["step_probe"] = test.probe_seconds();
  seconds["output"] = recorded.output;
  double known = 0.;
  for (const auto &[phase, spent] : seconds)
    known += spent;
  seconds["other"] = std::max(0., recorded.total - known);
  seconds["total"] = recorded.total;
  seconds[processor_time] = processor_seconds();
  if (test.stage() != Stage::preparation)
  {
    seconds[loading_processor_time] =
        processor_seconds() - recorded.preparation_processor;
    seconds[loading_wall_time] = recorded.total - recorded.preparation;
  }
  for (const auto &[phase, spent] : before)
    seconds[phase] += spent;
  return seconds;
}

namespace
{
/// Errors are what all jumps together have brought too much, as judged.
void add_jumps(const coupling::JumpAccount &jumps, nlohmann::ordered_json &out)
{
  out["skipped_cycles_1"] = jumps.n_skipped;
  out["n_jumps"] = jumps.n_jumps;
  out["n_refused_jumps"] = jumps.n_refused;
  out["jump_strain_error_1"] = jumps.strain_error;
  out["jump_laa_error_percent"] = jumps.abrasion_error;
}
/// Of the quads of the membrane, those that a particle presses on: a vertex in
/// the middle of each, after the nodes, has a share of every load on it [-].
double pressed_share(const Triaxial &test)
{
  const auto loads = std::span(dem::surface(test.engine()).load)
                         .subspan(test.membrane()->n_nodes());
  return static_cast<double>(std::ranges::count_if(
             loads, [](const dem::Vec3 &load) { return !load.isZero(0.); })) /
         static_cast<double>(loads.size());
}
} // namespace

std::string summary_text(const Case &parameters, const Triaxial &test,
                         const RunRecord &record, const CycleRecorder &cycles)
{
  const dem::Engine &engine = test.engine();
  const auto &breakable = engine.particles().is_breakable;
  const Triaxial::Prepared &prepared = test.prepared();
  const EnergyBalance balance = loading_balance(record.start, record.end);
  nlohmann::ordered_json out;
  out["kind"] = "dynamic_triaxial";
  out["title"] = parameters.title;
  out["is_complete"] = test.cycle() >= parameters.loading.n_cycles();
  out["lateral"] =
      parameters.boundary.lateral == Lateral::membrane ? "membrane" : "rigid";
  out["n_particles"] = engine.particles().size();
  out["n_breakable"] =
      std::count(breakable.begin(), breakable.end(), std::uint8_t{1});
  out["solid_volume_m3"] = solid_volume(engine.particles());
  out["gradation_error_1"] = record.gradation_error;
  out["initial_porosity"] = prepared.porosity;
  out["time_step_s"] = test.time_step();
  const StepRecord &steps = test.step_record();
  if (parameters.time.step == StepRule::fixed)
    out["step_over_limit_1"] = steps.worst_share;
  else
  {
    out["shortest_step_s"] = steps.shortest_used;
    out["longest_step_s"] = steps.longest_used;
  }
  if (parameters.time.step == StepRule::error)
  {
    const coupling::StepErrors errors = errors_of(test.step_probe());
    out["force_error_1"] = errors.force;
    out["energy_error_1"] = errors.energy;
    out["n_probe_steps"] = test.step_probe().n_extra_steps;
  }
  out["n_steps"] = engine.n_steps();
  out["n_rebuilds"] = engine.n_rebuilds();
  out["cycles_1"] = record.end.cycle;
  out["threads"] = record.threads;
  out["peak_axial_stress_Pa"] = record.peak_axial_stress;
  out["permanent_axial_strain_1"] = record.end.axial_strain;
  out["permanent_volumetric_strain_1"] = record.end.volumetric_strain;
  out["laa_percent"] = record.end.laa;
  out["porosity_start_1"] = record.start.porosity;
  out["porosity_end_1"] = record.end.porosity;
  out["coordination_start_1"] = record.start.coordination_number;
  out["coordination_end_1"] = record.end.coordination_number;
  out["coordination_change_1"] =
      record.end.coordination_number - record.start.coordination_number;
  out["roundness_start_1"] = record.start.roundness;
  out["roundness_end_1"] = record.end.roundness;
  out["roundness_change_1"] = record.end.roundness - record.start.roundness;
  cycles.add_to(out);
  if (parameters.cycle_jump.is_on())
    add_jumps(test.jumps().account(), out);
  out["n_events"] = engine.n_events();
  out["n_refused_events"] = engine.n_refused_events();
  out["external_work_J"] = balance.external_work;
  add_energy_balance(balance, out);
  out["overlap_over_radius_1"] = engine.overlaps().largest;
  add_contact_places(engine, out);
  if (test.gain())
  {
    out["exchange_gain_1"] = test.gain()->gain;
    if (std::isfinite(test.gain()->limit))
      out["exchange_gain_limit_1"] = test.gain()->limit;
    out["worst_gain_1"] = record.worst_gain;
    if (test.membrane())
    {
      out["n_membrane_quads"] = test.membrane()->mesh().quads.size();
      out["membrane_pressed_share_1"] = pressed_share(test);
    }
    if (test.exchange())
      add_ledger(*test.exchange(), out);
  }
  out["preparation"] = {
      {"stress_Pa",
       {prepared.stress.x(), prepared.stress.y(), prepared.stress.z()}},
      {"unbalanced_force_ratio_1", prepared.unbalanced_ratio},
      {"time_s", prepared.time},
      {"hash", hex_text(prepared.hash)},
      {"is_taken", prepared.is_taken != 0}};
  const Triaxial::Consolidated &rest = test.consolidated();
  out["consolidation"] = {
      {"time_s", rest.time},
      {"load_error_1", std::max(rest.load_error, rest.swing)},
      {"side_stress_error_1", rest.side_error},
      {"unbalanced_force_ratio_1", rest.unbalanced_ratio}};
  out["warnings"] = test.warnings(balance);
  add_cost(record.seconds, out);
  out["version"] = SPALL_VERSION;
  return out.dump(2) + "\n";
}
} // namespace spall
