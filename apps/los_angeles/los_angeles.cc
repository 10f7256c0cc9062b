#include "los_angeles/los_angeles.h"

#include "case/gravity.h"
#include "case/parameter.h"
#include "errors.h"
#include "specimen/mesh_walls.h"
#include "specimen/obtained_gradation.h"
#include "specimen/placed_particles.h"
#include "test/checkpoint.h"
#include "test/roundness_table.h"

#include <dem/binary.h>
#include <dem/engine_boundaries.h>
#include <dem/measure/assembly.h>
#include <dem/packing/insertion.h>
#include <dem/packing/pouring.h>
#include <dem/parallel/mpi_ranks.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <utility>

namespace spall
{
namespace
{
double spin_of(const DrumParameters &d)
{
  return d.turns_per_minute / 60. * 2. * std::numbers::pi;
}

/// Particles by the gradation, then the balls; largest first, as they are
/// placed.
std::vector<dem::ParticleShape> make_charge(const Case &parameters,
                                            const ShapeLibrary &shapes,
                                            dem::Random &random)
{
  const ChargeParameters &c = parameters.charge;
  std::vector<dem::ParticleShape> bodies = draw_particles(
      parameters, c.mass / parameters.particle.density, shapes, random);
  if (bodies.empty())
    throw InputError(parameters.file +
                     ": Charge/mass = " + number_text(c.mass) +
                     ": too small for a single particle of the gradation");
  if (c.balls > 0)
  {
    const double volume = c.ball_mass / c.balls / c.steel.density;
    const dem::ParticleShape ball =
        dem::make_sphere(std::cbrt(0.75 * volume / std::numbers::pi));
    bodies.insert(bodies.begin(), static_cast<std::size_t>(c.balls), ball);
  }
  return bodies;
}

dem::EngineParameters engine_settings(const Case &parameters,
                                      const PlacedParticles &charge)
{
  dem::EngineParameters settings;
  settings.particle = parameters.particle;
  settings.other_solids = {parameters.charge.steel};
  settings.wall = settings.surface = parameters.wall;
  settings.geometry = parameters.contact;
  settings.friction_limit = parameters.friction_limit;
  settings.breakage = parameters.breakage;
  settings.local_damping = parameters.time.local_damping;
  settings.gravity = -gravity * dem::Vec3::UnitZ();
  settings.geometry.usual_skin = 0.25 * charge.smallest_radius();
  return settings;
}

/// In a box about the axis that the lifter, which points up, does not reach.
std::vector<dem::Placement>
place_charge(const Case &parameters,
             const std::vector<dem::ParticleShape> &bodies, dem::Random &random)
{
  const DrumParameters &d = parameters.drum;
  const double half = d.radius / std::numbers::sqrt2;
  const dem::Vec3 corner(half, 0.5 * d.length, half);
  try
  {
    return dem::insert_particles(bodies,
                                 {-corner, corner,
                                  parameters.contact.follows_surfaces(), false,
                                  clear_of_walls(parameters)},
                                 random);
  }
  catch (const dem::NoFreePosition &error)
  {
    throw InputError(
        parameters.file + ": " + error.what() + " between lifter and axis: " +
        "Charge/mass = " + number_text(parameters.charge.mass) +
        " kg must be lower, or Drum/radius = " + number_text(d.radius) +
        " m or Drum/length = " + number_text(d.length) + " m larger");
  }
}
PlacedParticles drawn_charge(const Case &parameters)
{
  const ChargeParameters &c = parameters.charge;
  PlacedParticles charge;
  charge.shapes = load_shapes(parameters, "Charge", c.shapes, c.order);
  dem::Random random(static_cast<std::uint64_t>(c.seed));
  const std::vector<dem::ParticleShape> bodies =
      make_charge(parameters, charge.shapes, random);
  charge.add_at_rest(bodies, place_charge(parameters, bodies, random), "Charge",
                     static_cast<std::size_t>(c.balls));
  return charge;
}

void add_boundaries(const Case &parameters, dem::Engine &engine)
{
  const DrumParameters &d = parameters.drum;
  dem::Drum shell;
  shell.radius = d.radius;
  shell.length = d.length;
  shell.lifter_height = d.lifter_height;
  shell.lifter_thickness = d.lifter_thickness;
  dem::set_drum(engine, shell);
  add_mesh_walls(engine, parameters);
}

PlacedParticles placed_charge(const Case &parameters)
{
  const ChargeParameters &c = parameters.charge;
  PlacedParticles charge =
      place_particles(parameters, {"Charge", c.particles, c.shapes, c.order,
                                   "the steel balls of section Charge"});
  check_as_placed(
      parameters, charge,
      {"Charge", c.largest_overlap, engine_settings(parameters, charge),
       [&](dem::Engine &engine) { add_boundaries(parameters, engine); }});
  return charge;
}
} // namespace

/// What the constructor hands on: shapes, and the engine with all in it.
struct LosAngeles::Scene
{
  ShapeLibrary shapes;
  std::unique_ptr<dem::Engine> engine;

  explicit Scene(const Case &parameters)
  {
    const PlacedParticles charge = parameters.charge.particles.empty()
                                       ? drawn_charge(parameters)
                                       : placed_charge(parameters);
    shapes = charge.shapes;
    engine = std::make_unique<dem::Engine>(engine_settings(parameters, charge),
                                           dem::ranks_of_program());
    add_particles(charge, *engine);
    add_boundaries(parameters, *engine);
    engine->set_breaking(false);
  }
};

LosAngeles::LosAngeles(const Case &c) : LosAngeles(c, Scene(c)) {}

LosAngeles::LosAngeles(const Case &c, Scene scene)
    : Test(c, std::move(scene.shapes), std::move(scene.engine)),
      last_turn(c.drum.turns)
{
}

void LosAngeles::stop_after(int turns)
{
  last_turn = std::min<double>(turns, parameters.drum.turns);
}

void LosAngeles::move(double time_step)
{
  turns_before = turns();
  if (!is_turning && is_settled())
    begin_turning();
  engine().advance_deferred(time_step);
  if (share_done() >= 1.)
    store_roundness();
}

/// The least settling time is over, and the charge is at rest or has had the
/// longest time. Without a settling time the drum turns at once.
bool LosAngeles::is_settled()
{
  constexpr std::int64_t rest_interval = 200; // steps
  const DrumParameters &d = parameters.drum;
  const double spent = engine().time();
  if (spent < d.settling_time)
    return false;
  if (is_rough || d.settling_time == 0. || d.settling_unbalanced_ratio >= 1.)
    return true;
  const bool is_over = spent > d.settling_time + d.settling_max_time;
  if (!is_over && engine().n_steps() % rest_interval != 0)
    return false;
  unrest = dem::unbalanced_weight_ratio(synchronized());
  return is_over || unrest <= d.settling_unbalanced_ratio;
}

void LosAngeles::begin_turning()
{
  is_turning = true;
  start_time = engine().time();
  dem::drum(engine()).spin = spin_of(parameters.drum);
  engine().set_breaking(parameters.breakage.is_active);
  store_roundness();
  report_step();
  char line[160];
  std::snprintf(line, sizeof line,
                "drum turns from %.3f s, unbalanced force over weight %.2g",
                start_time, unrest);
  say(line);
  for (const std::string &warning : unrest_warnings())
    say("warning: " + warning);
}

std::vector<std::string> LosAngeles::unrest_warnings() const
{
  const DrumParameters &d = parameters.drum;
  if (unrest <= d.settling_unbalanced_ratio)
    return {};
  return {"the charge was not at rest when the drum began to turn: unbalanced "
          "force over weight " +
          number_text(unrest) + ", Drum/settling_unbalanced_ratio = " +
          number_text(d.settling_unbalanced_ratio) +
          ": see Drum/settling_max_time"};
}

std::vector<std::string> LosAngeles::warnings() const
{
  std::vector<std::string> all = unrest_warnings();
  for (const std::string &more : Test::warnings())
    all.push_back(more);
  return all;
}

std::string LosAngeles::outcome() const
{
  const auto [mass, initial] = particle_masses();
  char text[160];
  std::snprintf(text, sizeof text,
                "LAA %.5f %%, mass lost %.4g g, roundness %.4f, drum work "
                "%.4g J, %lld events",
                abrasion_percent(), 1e3 * (initial - mass),
                roundness.mean(synchronized().particles(), ranks()),
                synchronized().energy().work_of("drum"),
                static_cast<long long>(engine().n_events()));
  return text;
}

void LosAngeles::store_roundness()
{
  files.push_back({roundness_file(engine().time() - start_time),
                   roundness_table(*this, roundness)});
}

std::vector<NamedText> LosAngeles::take_files()
{
  return std::exchange(files, {});
}

double LosAngeles::turns() const
{
  return dem::drum(engine()).angle / (2. * std::numbers::pi);
}

double LosAngeles::progress_at(double time) const
{
  return is_turning ? std::max(0., time - start_time) *
                          parameters.drum.turns_per_minute / 60.
                    : 0.;
}

double LosAngeles::share_done() const
{
  return turns() / last_turn;
}

double LosAngeles::duration() const
{
  return parameters.drum.settling_time +
         60. * last_turn / parameters.drum.turns_per_minute;
}

double LosAngeles::period() const
{
  return 60. / parameters.drum.turns_per_minute;
}

/// Until the particles have fallen, and the drum turns.
FastPreparation LosAngeles::fast_preparation()
{
  is_rough = true;
  while (!is_turning)
    advance();
  return {};
}

std::string LosAngeles::phase() const
{
  char text[40];
  std::snprintf(text, sizeof text, "turn %.2f", turns());
  return text;
}

FrameParts LosAngeles::frame_parts() const
{
  FrameParts parts{nullptr, true};
  parts.bodies.push_back({"drum", [this](std::ostream &out)
                          { dem::write_drum(out, dem::drum(engine())); }});
  return parts;
}

Due LosAngeles::due() const
{
  const auto has_passed = [this](double times_per_turn)
  {
    return times_per_turn > 0. && std::floor(turns() * times_per_turn) !=
                                      std::floor(turns_before * times_per_turn);
  };
  const DrumParameters &d = parameters.drum;
  Due due;
  due.row = has_passed(d.rows_per_turn) || share_done() >= 1.;
  due.frame = has_passed(d.frames_per_turn);
  due.checkpoint =
      d.checkpoint_every > 0 && has_passed(1. / d.checkpoint_every);
  return due;
}

std::vector<Quantity> LosAngeles::measured() const
{
  const dem::ContactNetwork network = dem::contact_network(synchronized());
  return {{"turn_1", turns()},
          {"torque_Nm", dem::drum(engine()).torque},
          {"drum_work_J", synchronized().energy().work_of("drum")},
          {"n_contacts_1", static_cast<double>(network.n_contacts)},
          {"mean_contact_force_N", network.mean_force},
          {"roundness_1", roundness.mean(synchronized().particles(), ranks())}};
}

void LosAngeles::summarise(nlohmann::ordered_json &summary) const
{
  Test::summarise(summary);
  const auto [mass, initial] = particle_masses();
  summary["turns_1"] = turns();
  summary["initial_mass_kg"] = initial;
  summary["lost_mass_kg"] = initial - mass;
  summary["roundness_1"] = roundness.mean(engine().particles(), ranks());
}

void LosAngeles::save(std::ostream &out, dem::StateExtent extent) const
{
  Test::save(out, extent);
  dem::write_value(out, start_time);
  dem::write_value(out, turns_before);
  dem::write_value(out, is_turning);
  dem::write_value(out, unrest);
}

void LosAngeles::restore(std::istream &in)
{
  Test::restore(in);
  dem::read_value(in, start_time);
  dem::read_value(in, turns_before);
  dem::read_value(in, is_turning);
  dem::read_value(in, unrest);
  refuse_shorter("Drum/turns", turns(), parameters.drum.turns);
}
} // namespace spall
