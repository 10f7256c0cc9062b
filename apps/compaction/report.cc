// Messages of a vibratory compaction.
#include "case/parameter.h"
#include "compaction/compaction.h"
#include "test/roundness_table.h"

#include <dem/measure/assembly.h>

#include <nlohmann/json.hpp>

#include <cmath>
#include <cstdio>
#include <numbers>
#include <utility>

namespace spall
{
std::string Compaction::outcome() const
{
  char text[160];
  std::snprintf(
      text, sizeof text,
      "settlement %.4g mm, density %.5g kg/m^3, LAA %.5f %%, roundness %.4f, "
      "%lld events",
      now.stage == Stage::vibration ? 1e3 * (now.start_height - height()) : 0.,
      density(), abrasion_percent(),
      roundness.mean(synchronized().particles(), ranks()),
      static_cast<long long>(engine().n_events()));
  return text;
}

/// Where the filling has missed its required density.
std::vector<std::string> Compaction::density_warnings() const
{
  constexpr double noticeable = 0.005; // [-]
  if (pouring.layers().empty())        // packed roughly
    return {};
  const double asked = parameters.filling.density,
               reached = pouring.layers().back().density;
  if (std::abs(reached / asked - 1.) <= noticeable)
    return {};
  char line[200];
  std::snprintf(line, sizeof line,
                "filled to %.0f kg/m^3, Filling/density asks for %.0f: "
                "see Filling/max_strokes, tamper_pressure, friction",
                reached, asked);
  return {line};
}

std::vector<std::string> Compaction::warnings() const
{
  std::vector<std::string> all = Test::warnings();
  if (now.stage != Stage::filling)
    for (const std::string &warning : density_warnings())
      all.push_back(warning);
  return all;
}

void Compaction::report(double due)
{
  Report report;
  report.time = vibrated();
  report.settlement = now.start_height - height();
  report.density = density();
  report.abrasion = abrasion_percent();
  report.n_events = static_cast<double>(engine().n_events());
  report.roundness = roundness.mean(synchronized().particles(), ranks());
  const dem::ContactNetwork network = dem::contact_network(synchronized());
  report.coordination = network.coordination_number;
  report.mean_force = network.mean_force;
  reports.push_back(report);
  files.push_back({roundness_file(due), roundness_table(*this, roundness)});
}

std::vector<NamedText> Compaction::take_files()
{
  return std::exchange(files, {});
}

std::vector<Quantity> Compaction::measured() const
{
  const dem::ContactNetwork network = dem::contact_network(synchronized());
  const double dense = density();
  const bool is_vibrating = now.stage == Stage::vibration;
  std::vector<Quantity> row = {
      {"stage_1", static_cast<double>(now.stage)},
      {"vibration_s", vibrated()},
      {"settlement_m", is_vibrating ? now.start_height - height() : 0., true},
      {"density_kg_per_m3", dense, true},
      {"porosity_1", 1. - dense / parameters.particle.density},
      {"plate_height_m", height()},
      {"plate_velocity_m_per_s", plate ? plate->velocity() : 0.},
      {"plate_load_N", plate_load()},
      {"plate_impulse_Ns", now.impulse},
      {"lift_off_s", now.lift_off},
      {"n_contacts_1", static_cast<double>(network.n_contacts)},
      {"coordination_number_1", network.coordination_number},
      {"mean_contact_force_N", network.mean_force},
      {"roundness_1", roundness.mean(synchronized().particles(), ranks())}};
  if (parameters.plate.form != PlateKind::rigid)
    row.push_back({"plate_tilt_rad", plate ? plate->tilt() : 0.});
  if (parameters.plate.form == PlateKind::elastic)
    row.push_back({"plate_bending_m", plate ? plate->bending() : 0.});
  return row;
}

/// The tamper is the plate that does not tilt.
std::vector<NamedBoundary> Compaction::named_boundaries() const
{
  const bool is_plane = parameters.plate.form == PlateKind::rigid;
  std::vector<NamedBoundary> all = {
      {is_plane ? "plate" : "tamper", BoundaryKind::plane, pouring.tamper()}};
  if (!scene.room.container) // else it is a mesh wall, floor and all
  {
    all.insert(all.begin(), {"floor", BoundaryKind::plane, 0});
    all.push_back({container_name, BoundaryKind::drum});
  }
  if (!is_plane)
    all.push_back({"plate", BoundaryKind::surface});
  if (parameters.container.is_flexible())
    all.push_back({"membrane", BoundaryKind::surface});
  return all;
}

void Compaction::summarise(nlohmann::ordered_json &summary) const
{
  Test::summarise(summary);
  nlohmann::ordered_json layers = nlohmann::ordered_json::array();
  for (const dem::Pouring::Layer &layer : pouring.layers())
    layers.push_back({{"mass_kg", layer.mass},
                      {"height_m", layer.height},
                      {"density_kg_per_m3", layer.density},
                      {"tamper_pressure_Pa", layer.pressure},
                      {"strokes", layer.strokes},
                      {"friction_1", layer.friction},
                      {"time_s", layer.time}});
  dem::Pouring::Layer top;
  if (!pouring.layers().empty())
    top = pouring.layers().back();
  summary["filling"] = {{"density_asked_kg_per_m3", parameters.filling.density},
                        {"density_reached_kg_per_m3", top.density},
                        {"unbalanced_ratio_1", pouring.unbalanced_ratio()},
                        {"layers", layers}};
  const VibrationParameters &v = parameters.vibration;
  const double omega = 2. * std::numbers::pi * v.frequency;
  summary["static_load_N"] = weight();
  summary["exciter_force_N"] =
      v.eccentric_mass * v.eccentricity * omega * omega;
  summary["seating_settlement_m"] =
      now.stage == Stage::vibration ? top.height - now.start_height : 0.;
  const Report seated = reports.empty() ? Report() : reports.front();
  summary["seated_density_kg_per_m3"] = seated.density;
  summary["coordination_start_1"] = seated.coordination;
  summary["mean_contact_force_start_N"] = seated.mean_force;
  summary["vibration_s"] = vibrated();
  summary["settlement_m"] =
      now.stage == Stage::vibration ? now.start_height - height() : 0.;
  summary["density_kg_per_m3"] = density();
  summary["roundness_1"] = roundness.mean(synchronized().particles(), ranks());
  summary["mean_plate_load_N"] =
      vibrated() > 0. ? now.impulse / vibrated() : 0.;
  summary["peak_plate_load_N"] = now.peak_load;
  summary["peak_plate_acceleration_m_per_s2"] = now.peak_acceleration;
  summary["lift_off_s"] = now.lift_off;
  const dem::ContactNetwork network = dem::contact_network(synchronized());
  summary["coordination_end_1"] = network.coordination_number;
  summary["mean_contact_force_end_N"] = network.mean_force;
  nlohmann::ordered_json said = nlohmann::ordered_json::array();
  for (const Report &report : reports)
    said.push_back({{"vibration_s", report.time},
                    {"settlement_m", report.settlement},
                    {"density_kg_per_m3", report.density},
                    {"laa_percent", report.abrasion},
                    {"roundness_1", report.roundness},
                    {"n_events", report.n_events},
                    {"coordination_number_1", report.coordination},
                    {"mean_contact_force_N", report.mean_force}});
  summary["reports"] = said;
}
} // namespace spall
