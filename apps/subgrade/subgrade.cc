#include "subgrade/subgrade.h"

#include "case/gravity.h"
#include "case/parameter.h"
#include "errors.h"
#include "specimen/pouring_phase.h"
#include "subgrade/ground.h"

#include <dem/engine_boundaries.h>
#include <dem/measure/assembly.h>
#include <dem/measure/contact_springs.h>
#include <fem/disc_mesh.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace spall
{
namespace
{
constexpr std::int64_t rest_interval = 100; // moves between questions for rest
constexpr double rest_share = 0.01; // of the weight that may be in motion [-]
constexpr double rest_speed = 3e-4; // of the plate [m/s]
/// The static load comes on smoothly [s].
constexpr double ramp = 0.05;
/// While it is placed the guide brakes the plate: its speed would fall to 1/e
/// in this time [s].
constexpr double brake_time = 0.02;
/// Rows before the loading are this much rarer.
constexpr double patience = 10.;

double smooth(double share)
{
  const double x = std::clamp(share, 0., 1.);
  return x * x * (3. - 2. * x);
}

double sum_down(coupling::FieldView loads)
{
  double sum = 0.;
  for (const dem::Vec3 &load : loads)
    sum -= load.z();
  return sum;
}
} // namespace

Subgrade::Subgrade(const Case &c) : Subgrade(c, make_particle_box(c)) {}

Subgrade::Subgrade(const Case &c, ParticleBox its_scene)
    : Test(c, its_scene.shapes, std::move(its_scene.engine), its_scene.limit,
           first_step(c, its_scene.limit)),
      scene(std::move(its_scene)),
      pouring(scene.room, pouring_parameters(c), std::move(scene.layers),
              static_cast<std::uint64_t>(c.subgrade.layer.seed)),
      pulses(c),
      joined(std::make_unique<coupling::Exchange>(c.coupling.exchange_rules())),
      deflections(c)
{
  build_ground();
  const double smallest = scene.all.smallest_mass();
  const int n = stable_particle_steps(c, *ground, smallest, time_step());
  setup = ground_setup(c, *ground, smallest, time_step(), n);
  check_ground_setup(c, setup, n);
  scene.all = {}; // `pouring` has them
  joined->limit_windows(n, setup.window.one_pass_limit);
  for (const double depth : parse_depths(c.subgrade.record.stress_depths))
  {
    char name[60];
    std::snprintf(name, sizeof name, "vertical_stress_%gm_Pa", depth);
    stress_names.emplace_back(name);
  }
  dead_stress.assign(stress_names.size(), 0.);
  peak_stress = dead_stress;
  begin_pouring();
}

void Subgrade::build_ground()
{
  fem::Solid block = make_ground(parameters);
  const CouplingParameters &c = parameters.coupling;
  const fem::SolidMesh &mesh = block.mesh();
  mesh_size = {mesh.cells.size(), mesh.nodes.size()};
  std::unique_ptr<coupling::DeformableBody> body;
  if (parameters.subgrade.ground.body == GroundBody::full)
  {
    build_axis(mesh);
    auto full = std::make_unique<coupling::SolidBody>(
        std::move(block), fem::z_upper,
        coupling::BodySteps{c.is_body_implicit, c.body_steps});
    solid = full.get();
    top = full->mesh();
    body = std::move(full);
  }
  else
  {
    auto reduced = std::make_unique<coupling::CondensedBody>(
        block, fem::z_upper, parameters.subgrade.ground.inner_modes,
        c.body_steps, c.rules.particle_steps * time_step());
    condensed = reduced.get();
    top = reduced->mesh();
    body = std::move(reduced);
  }
  const auto position = [this](std::int32_t node) -> const dem::Vec3 &
  { return top.nodes[static_cast<std::size_t>(node)]; };
  for (std::int32_t k = 0; k < static_cast<std::int32_t>(top.nodes.size()); ++k)
  {
    if (position(k).norm() < position(middle).norm())
      middle = k;
    if (std::abs(position(k).y()) < 1e-9) // on a line of the mesh
      cut.push_back(k);
  }
  std::ranges::sort(cut, {}, [&](std::int32_t k) { return position(k).x(); });
  bowl.assign(cut.size(), 0.);
  area = fem::area_shares(top);
  ground = &joined->add(std::move(body), top, "subgrade",
                        parameters.subgrade.contact,
                        coupling::ParticleSide::outside, engine());
  joined->hold(*ground, true);
}

void Subgrade::build_axis(const fem::SolidMesh &mesh)
{
  const std::string &text = parameters.subgrade.record.stress_depths;
  const std::vector<double> depths = parse_depths(text);
  axis = fem::GroundAxis(mesh, depths);
  if (!depths.empty() && depths.back() >= axis.depth())
    throw InputError(parameters.file + ": Record/stress_depths = " + text +
                     ": must be less deep than the subgrade below the middle "
                     "of the plate, " +
                     number_text(axis.depth()) + " m");
}

void Subgrade::build_plate(double height)
{
  const LoadPlateParameters &p = parameters.subgrade.plate;
  const fem::SurfaceMesh surface = plate_surface(p, height);
  now.plate_start = height;
  auto body = std::make_unique<coupling::RigidBody>(
      plate_body(p, height), surface.nodes,
      coupling::RigidDrive{[this](double time) { return plate_load(time); },
                           {}});
  plate = body.get();
  joined->add(std::move(body), surface, "plate", parameters.wall,
              coupling::ParticleSide::outside, engine());
}

/// Weight, static load and pulse at a time of the body, which began when it was
/// placed.
fem::PlateLoad Subgrade::plate_load(double body_time) const
{
  const LoadPlateParameters &p = parameters.subgrade.plate;
  const bool is_loading = now.stage >= Stage::loading;
  double down = p.mass * gravity +
                p.static_load * (is_loading ? 1. : smooth(body_time / ramp));
  if (is_loading)
    down += pulses(body_time - (now.loaded_at - now.placed_at));
  fem::PlateLoad load;
  if (!is_loading && plate)
  {
    const fem::PlateBody &body = plate->plate();
    load.force = -p.mass / brake_time * body.velocity();
    load.moment =
        -plate_body(p, 0.).inertia.minCoeff() / brake_time * body.spin();
  }
  load.force.z() -= down;
  return load;
}

int Subgrade::steps_in_move() const
{
  return now.stage == Stage::pouring ? 1 : joined->particle_steps();
}

Surroundings Subgrade::surroundings() const
{
  if (now.stage == Stage::pouring)
    return {};
  return {joined.get(), ground, setup.window, joined->particle_steps()};
}

void Subgrade::move(double time_step)
{
  const double before = engine().time();
  const Stage stage_before = now.stage;
  if (now.stage == Stage::pouring)
    pour(time_step);
  else if (now.stage == Stage::placing)
    place(time_step);
  else
    load_plate(time_step);
  note_due(before);
  if (now.stage == Stage::loading && stage_before == Stage::placing)
    due_now = {true, true, parameters.subgrade.record.checkpoint_interval > 0.};
  if (due_now.row && now.stage >= Stage::loading)
    note_row();
}

/// Particles and plate: what carries them is what they weigh, and no particle
/// is out of balance.
bool Subgrade::is_at_rest() const
{
  const LoadPlateParameters &p = parameters.subgrade.plate;
  const double on_plate = p.mass * gravity + p.static_load;
  return plate->plate().velocity().norm() < rest_speed &&
         std::abs(force_on_plate() - on_plate) < rest_share * on_plate &&
         dem::unbalanced_weight_ratio(synchronized()) <
             parameters.subgrade.layer.unbalanced_ratio;
}

void Subgrade::place(double time_step)
{
  exchange_window(*joined, joined->particle_steps() * time_step);
  const double spent = engine().time() - now.placed_at;
  const bool is_asked =
      joined->n_windows() % rest_interval == 0 && spent > 2. * ramp;
  if (is_asked && is_at_rest())
    start_loading();
  else if (spent > parameters.subgrade.layer.max_time)
    throw RunFailure("plate and particles are not at rest " +
                     std::to_string(spent) +
                     " s after the plate was placed: see Layer/max_time, "
                     "unbalanced_ratio, local_damping");
}

void Subgrade::start_loading()
{
  now.loaded_at = engine().time();
  now.plate_rest = plate->plate().centre().z();
  now.height =
      now.plate_start + now.plate_rest -
      plate_body(parameters.subgrade.plate, now.plate_start).centre.z();
  now.porosity = 1. - dem::solid_volume(synchronized().particles(), ranks()) /
                          scene.room.volume_below(now.height);
  if (now.porosity <= 0.)
    throw RunFailure("porosity of the layer " + number_text(now.porosity) +
                     ": the particles interpenetrate: stiffer contacts "
                     "(Particle/shear_modulus, Wall and GroundContact"
                     "/normal_stiffness) or less load on the plate");
  now.coordination = dem::contact_network(synchronized()).coordination_number;
  const coupling::FieldView loads = joined->load_on(*ground);
  rest_load.assign(loads.begin(), loads.end());
  now.dead_load = sum_down(rest_load);
  lay_on_ground();
  engine().set_local_damping(parameters.time.local_damping);
  engine().set_breaking(parameters.breakage.is_active);
  now.stage = Stage::loading;
  report_step();
  now.density = density();
  now.roundness = roundness.mean(synchronized().particles(), ranks());
  note_roundness(0.);
  record.begin(parameters.subgrade.record.slices, now.height,
               solid ? axis.heights(solid->solid()) : std::vector<double>());
  now.energies = energy_balance();
}

void Subgrade::load_plate(double time_step)
{
  exchange_window(*joined, joined->particle_steps() * time_step);
  deflections.note(loading_time(), plate_settlement());
  if (loading_time() < duration())
    return;
  now.stage = Stage::done;
  note_roundness(duration());
  files.push_back(
      {"transfer.csv",
       record.transfer_table(parameters.subgrade.record.highest_frequency)});
  files.push_back({"profile.csv", record.profile_table()});
  files.push_back({"bowl.csv", bowl_table()});
  if (!deflections.empty())
    files.push_back({"pulses.csv", deflections.table()});
}

double Subgrade::loading_time() const
{
  return now.stage < Stage::loading ? 0. : engine().time() - now.loaded_at;
}

double Subgrade::progress_at(double time) const
{
  return now.stage < Stage::loading ? 0. : std::max(0., time - now.loaded_at);
}

double Subgrade::share_done() const
{
  return now.stage == Stage::done
             ? 1.
             : std::min(loading_time() / duration(), 1. - 1e-9);
}

double Subgrade::duration() const
{
  return pulses.duration() + parameters.subgrade.pulse.rest;
}

double Subgrade::frame_interval() const
{
  return parameters.subgrade.record.frame_interval;
}

std::string Subgrade::outcome() const
{
  char text[200];
  std::snprintf(text, sizeof text,
                "settlement of the plate %.4g mm, at most %.4g mm, of the "
                "subgrade at most %.4g mm, largest force on it %.4g N, %lld "
                "events",
                1e3 * plate_settlement(), 1e3 * now.lowest, 1e3 * now.deepest,
                now.peak_force, static_cast<long long>(engine().n_events()));
  return text;
}

std::string Subgrade::phase() const
{
  if (now.stage < Stage::loading)
    return now.stage == Stage::pouring ? pouring_phase(pouring, engine().time())
                                       : "placing";
  char text[40];
  std::snprintf(text, sizeof text, "loading %.4f s", loading_time());
  return text;
}

/// What is due after a move that began at this time.
void Subgrade::note_due(double before)
{
  const RecordParameters &r = parameters.subgrade.record;
  const bool is_loading = now.stage >= Stage::loading;
  const double origin = is_loading ? now.loaded_at : 0.;
  const auto has_passed = [&](double interval)
  {
    const auto count = [&](double time)
    { return std::floor((time - origin) / interval + 1e-6); };
    return interval > 0. && count(engine().time()) != count(before);
  };
  due_now.row =
      has_passed(is_loading ? r.row_interval : patience * r.row_interval);
  due_now.frame = is_loading && has_passed(r.frame_interval);
  due_now.checkpoint = has_passed(r.checkpoint_interval);
}

void Subgrade::describe() const
{
  if (const double cornered =
          dem::corner_step(engine().parameters(),
                           unplaced_particles(parameters, pouring.particles()));
      std::isfinite(cornered))
    std::printf("in a corner      %.4g s (the same particle on three walls)\n",
                cornered);
  std::printf("subgrade         %zu cells, %zu nodes, %s\n", mesh_size.first,
              mesh_size.second,
              solid ? "full" : "condensed on the nodes of its top");
  std::printf("loading          %.4g s of pulses, impulse %.4g N s, then %.4g "
              "s of rest\n",
              pulses.duration(), pulses.impulse(),
              parameters.subgrade.pulse.rest);
}

double Subgrade::plate_settlement() const
{
  return now.stage < Stage::loading
             ? 0.
             : now.plate_rest - plate->plate().centre().z();
}

/// Of the top below the middle of the plate, whose height was zero.
double Subgrade::ground_settlement() const
{
  return settlement_at(middle);
}

/// Of the whole top.
double Subgrade::mean_settlement() const
{
  double sum = 0.;
  for (std::size_t k = 0; k < area.size(); ++k)
    sum += area[k] * settlement_at(static_cast<std::int32_t>(k));
  return sum;
}

double Subgrade::settlement_at(std::int32_t node) const
{
  return -ground->motion().position[static_cast<std::size_t>(node)].z();
}

/// Down [N].
double Subgrade::force_on_ground() const
{
  return sum_down(dem::surface(engine(), 0).load);
}

/// Up [N].
double Subgrade::force_on_plate() const
{
  return plate ? -sum_down(dem::surface(engine(), 1).load) : 0.;
}

/// At the depths, more than the dead load does [Pa].
std::vector<double> Subgrade::stresses() const
{
  return solid ? axis.stresses(solid->solid()) : std::vector<double>();
}

void Subgrade::note_row()
{
  const double time = loading_time();
  const double plate_down = -plate->plate().velocity().z();
  const double ground_down =
      -ground->motion().velocity[static_cast<std::size_t>(middle)].z();
  record.add({time, pulses(time), plate_down, ground_down});
  record.add_particles(synchronized(), footprint(parameters.subgrade.plate));
  if (solid)
    record.add_ground(axis.speeds(solid->solid()));
  now.fastest = std::max(now.fastest, fastest_particle());
  now.lowest = std::max(now.lowest, plate_settlement());
  if (ground_settlement() > now.deepest)
  {
    now.deepest = ground_settlement();
    for (std::size_t k = 0; k < cut.size(); ++k)
      bowl[k] = settlement_at(cut[k]);
  }
  now.peak_force = std::max(now.peak_force, force_on_ground());
  now.worst_gain = std::max(
      now.worst_gain,
      joined->gain(synchronized(), joined->particle_steps() * time_step()));
  const std::vector<double> stress = stresses();
  for (std::size_t k = 0; k < stress.size(); ++k)
    peak_stress[k] = std::max(peak_stress[k], stress[k]);
}

double Subgrade::fastest_particle() const
{
  const dem::ParticleSystem &own = synchronized().particles();
  return dem::largest_of_particles(
      engine(), 0., [&own](std::size_t i) { return own.velocity(i).norm(); });
}

std::vector<Quantity> Subgrade::measured() const
{
  const dem::ContactNetwork network = dem::contact_network(synchronized());
  const dem::ParticleSystem &own = engine().particles();
  const auto n = static_cast<double>(dem::total_particles(engine()));
  const auto [sum] = dem::sum_particles<1>(
      engine(), [&own](std::size_t i)
      { return std::array{own.velocity(i).squaredNorm()}; });
  const double time = loading_time();
  const auto ground_speed =
      ground->motion().velocity[static_cast<std::size_t>(middle)];
  const double stage =
      std::min(static_cast<double>(now.stage),
               static_cast<double>(Stage::loading)); // the report's loading
  std::vector<Quantity> row = {
      {"stage_1", stage},
      {"loading_time_s", time},
      {"load_N", now.stage < Stage::loading ? 0. : pulses(time)},
      {"plate_settlement_m", plate_settlement()},
      {"plate_velocity_m_per_s", plate ? -plate->plate().velocity().z() : 0.},
      {"subgrade_settlement_m", ground_settlement()},
      {"subgrade_velocity_m_per_s", -ground_speed.z()},
      {"subgrade_mean_settlement_m", mean_settlement()},
      {"plate_force_N", force_on_plate()},
      {"subgrade_force_N", force_on_ground()},
      {"particle_velocity_rms_m_per_s", std::sqrt(sum / std::max(1., n))},
      {"particle_velocity_peak_m_per_s", fastest_particle()},
      {"coordination_number_1", network.coordination_number},
      {"n_contacts_1", static_cast<double>(network.n_contacts)},
      {"mean_contact_force_N", network.mean_force}};
  const std::vector<double> stress = stresses();
  for (std::size_t k = 0; k < stress.size(); ++k)
    row.push_back({stress_names[k].c_str(), stress[k]});
  if (solid && yields(parameters.subgrade.ground))
    row.push_back(
        {"subgrade_plastic_dissipation_J", solid->solid().energy().plastic});
  row.push_back({"bodies_stored_energy_J", body_energy().stored});
  return row;
}

coupling::BodyEnergy Subgrade::body_energy() const
{
  coupling::BodyEnergy sum = ground->energy();
  if (plate)
  {
    const coupling::BodyEnergy e = plate->energy();
    sum.kinetic += e.kinetic;
    sum.external += e.external;
    sum.load_work += e.load_work;
  }
  // What the ground gets back from the load it rests under is stored in it.
  sum.stored -= ground->energy().external;
  sum.external -= ground->energy().external;
  return sum;
}

std::vector<dem::BreakageEvent> Subgrade::fresh_events()
{
  auto events = joined->take_events();
  const auto last = Test::fresh_events();
  events.insert(events.end(), last.begin(), last.end());
  return events;
}
} // namespace spall
