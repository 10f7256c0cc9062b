#include "case/parameter.h"
#include "subgrade/poured.h"
#include "subgrade/quad_file.h"
#include "subgrade/subgrade.h"
#include "test/roundness_table.h"

#include <dem/binary.h>
#include <dem/measure/assembly.h>
#include <dem/measure/solid_fraction.h>

#include <nlohmann/json.hpp>

#include <cmath>
#include <utility>

namespace spall
{
namespace
{
void add_stresses(const std::vector<std::string> &names,
                  const std::vector<double> &dead,
                  const std::vector<double> &peak,
                  nlohmann::ordered_json &summary)
{
  for (std::size_t k = 0; k < names.size(); ++k)
    summary["stresses"][names[k]] = {{"dead_load", dead[k]},
                                     {"peak_of_pulses", peak[k]}};
}
} // namespace

void Subgrade::summarise(nlohmann::ordered_json &summary) const
{
  Test::summarise(summary);
  summary["subgrade_cells"] = mesh_size.first;
  summary["subgrade_nodes"] = mesh_size.second;
  summary["exchange_gain_1"] = setup.gain->gain;
  if (std::isfinite(setup.gain->limit))
    summary["exchange_gain_limit_1"] = setup.gain->limit;
  summary["worst_gain_1"] = now.worst_gain;
  summary["layer_height_m"] = now.height;
  summary["initial_porosity"] = now.porosity;
  summary["dead_load_N"] = now.dead_load;
  summary["loading_time_s"] = loading_time();
  summary["plate_settlement_m"] = plate_settlement();
  summary["plate_settlement_peak_m"] = now.lowest;
  deflections.summarise(summary);
  summary["subgrade_settlement_m"] = ground_settlement();
  summary["subgrade_settlement_peak_m"] = now.deepest;
  summary["subgrade_force_peak_N"] = now.peak_force;
  summary["particle_velocity_peak_m_per_s"] = now.fastest;
  if (now.stage >= Stage::loading)
  {
    const double mean = roundness.mean(synchronized().particles(), ranks());
    summary["density_start_kg_per_m3"] = now.density;
    summary["density_kg_per_m3"] = density();
    summary["roundness_start_1"] = now.roundness;
    summary["roundness_end_1"] = mean;
    summary["roundness_change_1"] = mean - now.roundness;
  }
  summary["pulse_impulse_Ns"] = pulses.impulse();
  summary["pulse_impulse_of_rows_Ns"] = record.impulse();
  if (solid && yields(parameters.subgrade.ground))
  {
    summary["subgrade_plastic_dissipation_J"] = solid->solid().energy().plastic;
    summary["subgrade_yielded_share_1"] = solid->solid().yielded_share();
  }
  if (!pulses.passes().empty())
    summary["axle_times_s"] = pulses.passes();
  add_stresses(stress_names, dead_stress, peak_stress, summary);
  summary["coordination_start_1"] = now.coordination;
  summary["coordination_end_1"] =
      dem::contact_network(synchronized()).coordination_number;
  if (now.stage < Stage::loading)
    return;
  EnergyBalance loading = energy_balance();
  loading -= now.energies;
  summary["loading_work_J"] = loading.external_work;
  summary["loading_energy_residual_J"] = loading.residual;
  summary["loading_non_conservative_work_J"] = loading.non_conservative_work;
}

std::string Subgrade::preparation_text() const
{
  return poured_text(parameters, shapes, top, ground->nodal_mass());
}

/// The ground has not moved yet.
void Subgrade::save_prepared(std::ostream &out) const
{
  pouring.save(out);
  Test::save(out, dem::StateExtent::scene);
}

void Subgrade::take_prepared(std::istream &in)
{
  pouring.restore(in);
  Test::restore(in);
  set_plate_down();
}

void Subgrade::save(std::ostream &out, dem::StateExtent extent) const
{
  dem::write_value(out, now);
  dem::write_value(out, due_now);
  dem::write_column(out, rest_load);
  dem::write_column(out, dead_stress);
  dem::write_column(out, peak_stress);
  dem::write_column(out, bowl);
  record.save(out);
  deflections.save(out);
  pouring.save(out);
  Test::save(out, extent);
  joined->save(out);
}

void Subgrade::restore(std::istream &in)
{
  dem::read_value(in, now);
  dem::read_value(in, due_now);
  dem::read_column(in, rest_load);
  dem::read_column(in, dead_stress);
  dem::read_column(in, peak_stress);
  dem::read_column(in, bowl);
  record.restore(in);
  deflections.restore(in);
  pouring.restore(in);
  if (now.stage >= Stage::placing && pours_by_own_steps())
    change_steps(parameters.time, step_limit().step);
  if (now.stage >= Stage::placing)
    build_plate(now.plate_start);
  if (now.stage >= Stage::loading)
    balance_ground();
  Test::restore(in);
  joined->restore(in);
}

FrameParts Subgrade::frame_parts() const
{
  std::vector<FrameBody> bodies = {{"subgrade", [this](std::ostream &out)
                                    {
                                      if (solid)
                                        solid->solid().write_vtu(out);
                                      else
                                        write_quads(out, condensed->mesh(),
                                                    ground->motion());
                                    }}};
  if (plate)
    bodies.push_back({"plate", [this](std::ostream &out)
                      {
                        write_quads(out,
                                    plate_surface(parameters.subgrade.plate,
                                                  now.plate_start),
                                    plate->motion());
                      }});
  return {nullptr, true, std::move(bodies)};
}

std::string Subgrade::bowl_table() const
{
  std::string text = "x_m,settlement_peak_m,settlement_end_m\n";
  for (std::size_t k = 0; k < cut.size(); ++k)
    text += number_text(top.nodes[static_cast<std::size_t>(cut[k])].x()) + "," +
            number_text(bowl[k]) + "," + number_text(settlement_at(cut[k])) +
            "\n";
  return text;
}

std::vector<NamedText> Subgrade::take_files()
{
  return std::exchange(files, {});
}

/// Of the layer right below the plate [kg/m^3].
double Subgrade::density() const
{
  const LoadPlateParameters &p = parameters.subgrade.plate;
  const double lower_face = now.plate_start + plate->plate().centre().z() -
                            plate_body(p, now.plate_start).centre.z();
  const dem::Prism column = column_below(p, -ground_settlement(), lower_face);
  return parameters.particle.density *
         of_whole([&](const dem::Engine &all)
                  { return dem::solid_fraction(column, all.particles()); });
}

void Subgrade::note_roundness(double time)
{
  files.push_back({roundness_file(time), roundness_table(*this, roundness)});
}

/// The sides in the order in which they were added; a mesh is a mesh wall.
std::vector<NamedBoundary> Subgrade::named_boundaries() const
{
  std::vector<NamedBoundary> all;
  if (!scene.room.container)
    all = {{"x_min", BoundaryKind::plane, 0},
           {"x_max", BoundaryKind::plane, 1},
           {"y_min", BoundaryKind::plane, 2},
           {"y_max", BoundaryKind::plane, 3}};
  all.push_back({"tamper", BoundaryKind::plane, pouring.tamper()});
  all.push_back({"plate", BoundaryKind::surface});
  all.push_back({"subgrade", BoundaryKind::surface});
  return all;
}
} // namespace spall
