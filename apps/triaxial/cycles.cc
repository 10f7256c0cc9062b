#include "triaxial/cycles.h"

#include "triaxial/triaxial.h"

#include <dem/binary.h>

#include <nlohmann/json.hpp>

#include <cmath>
#include <limits>
#include <utility>

namespace spall
{
namespace
{
constexpr const char *cycles_file = "cycles.csv";

struct CycleColumn
{
  const char *name; ///< name_unit
  double (*value)(const CycleRow &);
};

/// Before those of the contacts.
const std::vector<CycleColumn> cycle_columns = {
    {"cycle_1", [](const CycleRow &row) { return row.end.cycle; }},
    {"time_s", [](const CycleRow &row) { return row.end.time; }},
    {"permanent_axial_strain_1",
     [](const CycleRow &row) { return row.end.axial_strain; }},
    {"permanent_volumetric_strain_1",
     [](const CycleRow &row) { return row.end.volumetric_strain; }},
    {"resilient_axial_strain_1",
     [](const CycleRow &row) { return row.resilient_strain; }},
    {"resilient_modulus_Pa",
     [](const CycleRow &row) { return row.resilient_modulus; }},
    {"damping_ratio_1", [](const CycleRow &row) { return row.damping_ratio; }},
    {"laa_percent", [](const CycleRow &row) { return row.end.laa; }},
    {"roundness_1", [](const CycleRow &row) { return row.end.roundness; }},
    {"n_events_1", [](const CycleRow &row) { return row.n_events; }},
    {"friction_dissipation_J",
     [](const CycleRow &row) { return row.friction; }},
    {"rolling_dissipation_J", [](const CycleRow &row) { return row.rolling; }},
    {"damping_dissipation_J", [](const CycleRow &row) { return row.damping; }},
    {"breakage_energy_J", [](const CycleRow &row) { return row.breakage; }},
    {"external_work_J", [](const CycleRow &row) { return row.external_work; }},
    {"non_conservative_work_J",
     [](const CycleRow &row) { return row.non_conservative_work; }},
    {"energy_residual_J",
     [](const CycleRow &row) { return row.energy_residual; }},
    {"elastic_energy_J",
     [](const CycleRow &row) { return row.end.elastic_energy; }},
    {"kinetic_energy_J",
     [](const CycleRow &row) { return row.end.kinetic_energy; }},
    {"membrane_strain_energy_J",
     [](const CycleRow &row) { return row.end.membrane_strain_energy; }},
    {"stands_for_1", [](const CycleRow &row) { return row.stands_for; }}};

/// After those of the contacts.
const std::vector<CycleColumn> stage_columns = {
    {"loading_stage_1",
     [](const CycleRow &row) { return row.end.loading_stage; }},
    {"cycle_of_stage_1", [](const CycleRow &row) { return row.in_stage; }}};

std::string cycles_header()
{
  std::string header;
  const auto add = [&header](const std::string &name)
  {
    if (!header.empty())
      header += ',';
    header += name;
  };
  for (const CycleColumn &column : cycle_columns)
    add(column.name);
  for (const char *when : {"", "peak"})
    for (const NetworkColumn &column : network_columns)
      add(column.label(when));
  for (const CycleColumn &column : stage_columns)
    add(column.name);
  return header;
}

double deviator(const Sample &row)
{
  return row.axial_stress - row.lateral_stress;
}
} // namespace

CycleRecorder::CycleRecorder(LoadForm form, const LoadPath &path)
    : is_cyclic(path.has_waves()), has_path(form == LoadForm::path)
{
}

std::vector<TableHeader> CycleRecorder::tables() const
{
  std::vector<TableHeader> all;
  if (is_cyclic)
    all.push_back({cycles_file, cycles_header()});
  if (has_path)
    all.push_back({stages_file, stages_header()});
  return all;
}

std::vector<TableRow> CycleRecorder::take_rows()
{
  return std::exchange(rows, {});
}

std::vector<NamedText> CycleRecorder::take_files()
{
  return std::exchange(files, {});
}

void CycleRecorder::take(const Triaxial &test, const Sample &row)
{
  if (test.is_at_start())
  {
    state.start = network_state(test);
    state.skin =
        test.of_whole([&](const dem::Engine &scene)
                      { return coupling::skin_of(test.enclosed(scene)); });
    state.packed_start = note_profiles(test, "start");
    return begin_cycle(row);
  }
  state.packed_end = {}; // that of a continued loading
  state.loop.add(row.axial_strain, deviator(row));
  const bool is_stage_over = test.load_path().is_over();
  if (test.intervals() % test.intervals_per_cycle() != 0 && !is_stage_over)
    return;
  end_cycle(test, row);
  if (is_stage_over)
    end_stage(test, row);
  begin_cycle(row);
  if (test.is_complete())
    state.packed_end = note_profiles(test, "end");
}

void CycleRecorder::take_peak(const Triaxial &test)
{
  if (test.load_path().stage().has_wave())
    state.peak = network_state(test);
}

void CycleRecorder::begin_cycle(const Sample &row)
{
  state.begun = row;
  for (const NetworkColumn &column : network_columns)
    state.peak.*column.value = std::numeric_limits<double>::quiet_NaN();
  state.loop.begin(row.axial_strain, deviator(row));
}

void CycleRecorder::end_cycle(const Triaxial &test, const Sample &row)
{
  CycleRow &last = state.last;
  last.end = row;
  last.stands_for = std::round(row.cycle - state.begun.cycle);
  const bool has_wave = test.load_path().stage().has_wave();
  if (has_wave)
  {
    last.in_stage = std::round(test.cycles_of_stage());
    last.resilient_strain = state.loop.resilient_strain();
    last.resilient_modulus = state.loop.resilient_modulus();
    last.damping_ratio = state.loop.damping_ratio();
    state.last_loops.add(state.loop);
  }
  if (last.stands_for > 1.) // the loop is open: a jump is in it
    last.resilient_strain = last.resilient_modulus = last.damping_ratio =
        std::numeric_limits<double>::quiet_NaN();
  last.n_events = row.n_events - state.begun.n_events;
  last.friction = row.friction - state.begun.friction;
  last.rolling = row.rolling - state.begun.rolling;
  last.damping = row.damping - state.begun.damping;
  last.breakage = row.breakage - state.begun.breakage;
  last.external_work = row.external_work - state.begun.external_work;
  last.non_conservative_work =
      row.non_conservative_work - state.begun.non_conservative_work;
  last.energy_residual = row.energy_residual - state.begun.energy_residual;
  if (has_wave)
    last.peak = state.peak;
  last.rest = network_state(test);
  ++state.n_cycles;
  if (has_wave)
    add_cycle_row();
}

void CycleRecorder::add_cycle_row()
{
  const CycleRow &last = state.last;
  std::vector<double> values;
  for (const CycleColumn &column : cycle_columns)
    values.push_back(column.value(last));
  for (const NetworkState *when : {&last.rest, &last.peak})
    for (const NetworkColumn &column : network_columns)
      values.push_back(when->*column.value);
  for (const CycleColumn &column : stage_columns)
    values.push_back(column.value(last));
  rows.push_back({cycles_file, std::move(values)});
}

void CycleRecorder::end_stage(const Triaxial &test, const Sample &row)
{
  if (has_path)
    rows.push_back(
        {stages_file, stage_values(test.load_path(), row,
                                   test.cycles_of_stage(), state.last_loops)});
  state.last_loops = {};
}

CycleRecorder::Packed CycleRecorder::note_profiles(const Triaxial &test,
                                                   const std::string &when)
{
  std::string layers, sections;
  const Packed packed = test.of_whole(
      [&](const dem::Engine &scene) -> Packed
      {
        const dem::BoundaryProfile profile =
            coupling::boundary_profile(test.enclosed(scene));
        const std::vector<double> areas =
            coupling::section_areas(test.enclosed(scene));
        layers = profile_table(profile);
        sections = sections_table(areas);
        return {profile.porosity_skin, profile.porosity_inside,
                profile.coordination_skin, profile.coordination_inside,
                test.membrane() ? dem::bulge_of(areas) : 0.};
      });
  files.push_back({"boundary_profile_" + when + ".csv", layers});
  files.push_back({"sections_" + when + ".csv", sections});
  return packed;
}

void CycleRecorder::add_to(nlohmann::ordered_json &summary) const
{
  if (state.n_cycles == 0.)
    return;
  const CycleRow &last = state.last;
  const auto add = [&summary](const std::string &key, double value)
  {
    if (std::isfinite(value))
      summary[key] = value;
  };
  if (is_cyclic)
  {
    add("resilient_axial_strain_1", last.resilient_strain);
    add("resilient_modulus_Pa", last.resilient_modulus);
    add("damping_ratio_1", last.damping_ratio);
  }
  if (is_cyclic)
  {
    add("coordination_peak_1", last.peak.coordination_number);
    add("mean_contact_force_peak_N", last.peak.mean_contact_force);
  }
  const double force_start = state.start.mean_contact_force;
  add("mean_contact_force_start_N", force_start);
  add("mean_contact_force_end_N", last.rest.mean_contact_force);
  add("mean_contact_force_change_1",
      last.rest.mean_contact_force / force_start - 1.);
  for (const NetworkColumn &column : std::span(network_columns).subspan(2))
  {
    add(column.label("start"), state.start.*column.value);
    add(column.label(), last.rest.*column.value);
    if (is_cyclic)
      add(column.label("peak"), last.peak.*column.value);
  }
  add("skin_m", state.skin);
  add("porosity_skin_start_1", state.packed_start.porosity_skin);
  add("porosity_inside_start_1", state.packed_start.porosity_inside);
  add("coordination_skin_start_1", state.packed_start.coordination_skin);
  add("coordination_inside_start_1", state.packed_start.coordination_inside);
  add("bulge_start_1", state.packed_start.bulge);
  if (state.packed_end.porosity_inside > 0.)
  {
    add("porosity_skin_1", state.packed_end.porosity_skin);
    add("porosity_inside_1", state.packed_end.porosity_inside);
    add("coordination_skin_1", state.packed_end.coordination_skin);
    add("coordination_inside_1", state.packed_end.coordination_inside);
    add("bulge_1", state.packed_end.bulge);
  }
}

void CycleRecorder::save(std::ostream &out) const
{
  dem::write_value(out, state);
}

void CycleRecorder::restore(std::istream &in)
{
  dem::read_value(in, state);
}
} // namespace spall
