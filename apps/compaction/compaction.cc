#include "compaction/compaction.h"

#include "case/parameter.h"
#include "compaction/filling.h"
#include "errors.h"
#include "run/rest_hint.h"
#include "specimen/pouring_phase.h"
#include "test/checkpoint.h"
#include "test/slices.h"

#include <coupling/membrane_body.h>
#include <dem/binary.h>
#include <dem/engine_boundaries.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace spall
{
namespace
{
/// Of history.csv before the vibration [s].
constexpr double row_interval = 0.01;
} // namespace

Compaction::Compaction(const Case &c) : Compaction(c, make_compaction_scene(c))
{
}

Compaction::Compaction(const Case &c, CompactionScene its_scene)
    : Test(c, its_scene.shapes, std::move(its_scene.engine), its_scene.limit,
           its_scene.setup.step),
      scene(std::move(its_scene)),
      pouring(scene.room, pouring_parameters(c.filling),
              std::move(scene.layers),
              static_cast<std::uint64_t>(c.filling.seed)),
      report_dues(report_times(c.vibration.reports)),
      last_time(c.vibration.duration)
{
  for (std::size_t i = 0; i < scene.all.size(); ++i)
    filled_mass += scene.all.solid_mass(i);
  const double longest =
      dem::critical_step(engine().parameters(), scene.all).step;
  scene.all = {}; // `pouring` has them
  if (scene.placed)
    pouring.set_first_layer(*scene.placed);
  pouring.prepare(engine());
  if (!fills_by_own_steps())
    return;
  begin_steps(c.time.preparing(c.filling.safety), longest);
}

const dem::Plane &Compaction::plate_plane() const
{
  return dem::planes(engine())[pouring.tamper()];
}

bool Compaction::has_windows() const
{
  return parameters.container.is_flexible() ||
         parameters.plate.form == PlateKind::elastic;
}

coupling::ExchangeParameters Compaction::exchange_rules() const
{
  return has_windows() ? parameters.coupling.exchange_rules()
                       : coupling::ExchangeParameters{};
}

int Compaction::steps_in_move() const
{
  return joined ? exchange_rules().particle_steps : 1;
}

void Compaction::move(double time_step)
{
  now.stage_before = static_cast<std::int32_t>(now.stage);
  now.n_layers_before = static_cast<std::int64_t>(pouring.layers().size());
  now.time_before = engine().time();
  if (now.stage == Stage::filling)
    return fill(time_step);
  if (!joined)
    return lower_plate(time_step);
  step_joined(time_step);
}

void Compaction::fill(double time_step)
{
  steer_filling(time_step);
  engine().advance_deferred(time_step);
  if (!pouring.is_done())
    return;
  engine().synchronize();
  say_prepared();
  hand_over(height_above_layers());
}

/// What a layer without free positions or without rest depends on.
void Compaction::steer_filling(double time_step)
{
  const FillingParameters &f = parameters.filling;
  try
  {
    pouring.steer(engine(), time_step);
  }
  catch (const dem::NoFreePosition &error)
  {
    throw RunFailure(std::string(error.what()) + ": Filling/solid_fraction = " +
                     number_text(f.solid_fraction) +
                     " must be lower, or Filling/layers more");
  }
  catch (const dem::NoRest &error)
  {
    throw RunFailure(error.what() + rest_hint("Filling", f.max_time,
                                              f.unbalanced_ratio,
                                              f.local_damping));
  }
}

std::string Compaction::preparation_text() const
{
  return filling_text(parameters, shapes, step_limit().step);
}

void Compaction::take_prepared(std::istream &in)
{
  restore(in);
  hand_over(height_above_layers());
}

/// The plate comes as the tamper did, from where that had touched, or from
/// above a particle that has sprung up since [m].
double Compaction::height_above_layers() const
{
  const dem::ParticleSystem &own = synchronized().particles();
  const double top = dem::largest_of_particles(
      engine(), pouring.layers().back().height,
      [&](std::size_t i)
      {
        return own.position(i).z() +
               dem::wall_bound(own, i, parameters.contact.wall_geometry);
      });
  return top + 1e-3 * scene.room.width_x;
}

/// From the tamper to the plate, which comes from this height [m].
void Compaction::hand_over(double plate_height)
{
  if (fills_by_own_steps())
    change_steps(parameters.time, step_limit().step);
  engine().set_renewal(parameters.contact.refresh_tolerance,
                       parameters.contact.skin);
  engine().set_local_damping(parameters.time.local_damping);
  for (const std::string &warning : density_warnings())
    say("warning: " + warning);
  if (!pouring.layers().empty() &&
      pouring.layers().back().density >= parameters.particle.density)
    throw RunFailure(
        "filled to " + number_text(pouring.layers().back().density) +
        " kg/m^3, above Particle/density = " +
        number_text(parameters.particle.density) +
        ": the particles interpenetrate: stiffer contacts "
        "(Particle/shear_modulus, Wall/normal_stiffness) or a lower "
        "Filling/tamper_pressure");
  now.stage = Stage::seating;
  if (parameters.plate.form != PlateKind::rigid)
    return join(plate_height);
  dem::place_plane(engine(), pouring.tamper(),
                   plate_height * dem::Vec3::UnitZ());
}

/// Until the particles carry it. The last of its speed is too small to shake
/// it.
void Compaction::lower_plate(double time_step)
{
  constexpr double slowest = 0.02; // [-]
  const double carried = plate_plane().force.z() / weight();
  if (carried >= 1.)
  {
    join(plate_plane().point.z());
    return release(engine().time());
  }
  dem::planes(engine())[pouring.tamper()].velocity =
      -parameters.plate.seating_speed * std::clamp(1. - carried, slowest, 1.) *
      dem::Vec3::UnitZ();
  engine().advance_deferred(time_step);
}

double Compaction::weight() const
{
  return parameters.plate.load -
         parameters.plate.mass * engine().parameters().gravity.z();
}

void Compaction::join(double plate_height)
{
  now.join_time = engine().time();
  now.join_height = plate_height;
  now.plane_work_gone = plate_plane().work;
  build_plate();
}

/// The guide, which has held the plate until this time [s].
void Compaction::release(double time)
{
  now.release_time = time;
  plate->release(now.release_time - now.join_time);
  if (!parameters.container.is_flexible())
    return;
  // The mould is taken away.
  dem::Drum mould = dem::drum(engine());
  mould.radius *= 100.;
  dem::set_drum(engine(), mould);
  build_tube();
}

void Compaction::build_plate()
{
  joined = std::make_unique<coupling::Exchange>(exchange_rules());
  plate = std::make_unique<CompactionPlate>(
      parameters, now.join_height, pouring.tamper(), *joined, engine());
}

void Compaction::build_tube()
{
  const CouplingParameters &c = parameters.coupling;
  auto sleeve = std::make_unique<coupling::MembraneBody>(
      make_tube(parameters),
      coupling::BodySteps{c.is_body_implicit, c.body_steps});
  tube = sleeve.get();
  const fem::SurfaceMesh mesh = sleeve->membrane().mesh();
  joined->add(std::move(sleeve), mesh, "membrane", parameters.membrane_contact,
              coupling::ParticleSide::inside, engine());
}

void Compaction::step_joined(double time_step)
{
  const double window = steps_in_move() * time_step;
  if (tube)
    tube->membrane().set_pressure(
        parameters.container.pressure *
        std::min(1., 2. * (engine().time() + window - now.release_time) /
                         parameters.plate.seating_time));
  // With windows the impulse is set to zero when one begins.
  const double before = joined->rule() == coupling::ExchangeRule::every_step
                            ? plate->impulse(engine())
                            : 0.;
  const double speed = plate->velocity();
  exchange_window(*joined, window);
  if (now.stage == Stage::vibration)
    return follow_vibration(
        window, {plate->impulse(engine()) - before, plate->velocity() - speed});
  if (now.release_time == 0.)
  {
    if (plate->is_carried(engine()))
      release(engine().time());
  }
  else
    wait_for_rest();
}

void Compaction::start_vibration()
{
  engine().synchronize();
  now.stage = Stage::vibration;
  now.vibration_start = engine().time();
  plate->start_exciter(now.vibration_start - now.release_time);
  now.start_height = height();
  engine().set_breaking(parameters.breakage.is_active);
  report_step();
  report(0.);
}

void Compaction::follow_vibration(double window, const PlateChange &change)
{
  now.impulse += change.impulse;
  now.peak_load = std::max(now.peak_load, change.impulse / window);
  now.peak_acceleration =
      std::max(now.peak_acceleration, std::abs(change.velocity) / window);
  if (change.impulse == 0.)
    now.lift_off += window;
  for (const double due : report_dues)
    if (due <= vibrated() && due > vibrated() - window)
      report(due);
}

double Compaction::vibrated() const
{
  return progress_at(engine().time());
}

double Compaction::progress_at(double time) const
{
  return now.stage == Stage::vibration
             ? std::max(0., time - now.vibration_start)
             : 0.;
}

/// From the floor to the plate, of the vibration.
std::optional<SliceSpace> Compaction::slice_space() const
{
  if (now.stage != Stage::vibration)
    return {};
  const dem::FacetSurface *around = nullptr;
  if (tube)
    around = &dem::surface(engine());
  else if (scene.room.container)
    around = &scene.room.container->wall();
  return SliceSpace{0., height(),
                    [around, radius = 0.5 * scene.room.width_x](double z)
                    {
                      return around ? tube_section(*around, z)
                                    : dem::circle_polygon({0., 0.}, radius);
                    }};
}

/// Under the plate, or as it was last taken; 0 before.
double Compaction::height() const
{
  if (plate && plate->is_disc())
    return plate->height();
  if (now.stage != Stage::filling)
    return plate_plane().point.z();
  return pouring.layers().empty() ? 0. : pouring.layers().back().height;
}

double Compaction::plate_load() const
{
  return plate ? plate->load(engine()) : plate_plane().force.z();
}

double Compaction::volume() const
{
  return tube ? volume_below(tube->membrane(),
                             parameters.container.elements_around, height())
              : scene.room.volume_below(height());
}

/// Fines that are not there any more count, as they stay in the container.
double Compaction::density() const
{
  if (now.stage != Stage::filling)
    return filled_mass / volume();
  return pouring.layers().empty() ? 0. : pouring.layers().back().density;
}

double Compaction::share_done() const
{
  return vibrated() / last_time;
}

double Compaction::duration() const
{
  return parameters.plate.seating_time + last_time;
}

double Compaction::frame_interval() const
{
  const double rate = parameters.vibration.frames_per_second;
  return rate > 0. ? 1. / rate : 0.;
}

double Compaction::period() const
{
  return 1. / parameters.vibration.frequency;
}

std::string Compaction::phase() const
{
  if (now.stage == Stage::filling)
    return pouring_phase(pouring, engine().time());
  if (now.stage == Stage::seating)
    return "seating of the plate";
  char text[60];
  std::snprintf(text, sizeof text, "vibrated %.2f s", vibrated());
  return text;
}

Due Compaction::due() const
{
  Due due;
  const VibrationParameters &v = parameters.vibration;
  const bool is_new_stage =
      static_cast<std::int32_t>(now.stage) != now.stage_before;
  if (now.stage != Stage::vibration || is_new_stage)
  {
    due.row = is_new_stage || std::floor(engine().time() / row_interval) !=
                                  std::floor(now.time_before / row_interval);
    due.frame = is_new_stage;
    due.checkpoint = v.checkpoint_every > 0 &&
                     (is_new_stage ||
                      now.n_layers_before !=
                          static_cast<std::int64_t>(pouring.layers().size()));
    return due;
  }
  const double before = progress_at(now.time_before), after = vibrated();
  const auto has_passed = [&](double times_per_second)
  {
    return times_per_second > 0. && std::floor(before * times_per_second) !=
                                        std::floor(after * times_per_second);
  };
  due.row = has_passed(v.frequency * v.rows_per_period) || share_done() >= 1.;
  due.frame = has_passed(v.frames_per_second) || !files.empty();
  due.checkpoint =
      v.checkpoint_every > 0 && has_passed(v.frequency / v.checkpoint_every);
  return due;
}

void Compaction::stop_after(int periods)
{
  last_time = std::min(periods / parameters.vibration.frequency, last_time);
}

std::vector<dem::BreakageEvent> Compaction::fresh_events()
{
  auto events =
      joined ? joined->take_events() : std::vector<dem::BreakageEvent>{};
  for (dem::BreakageEvent &event : engine().take_events())
    events.push_back(event);
  return events;
}

coupling::BodyEnergy Compaction::body_energy() const
{
  coupling::BodyEnergy sum;
  if (!joined)
    return sum;
  sum = plate->energy();
  if (!tube)
    return sum;
  const coupling::BodyEnergy more = tube->energy();
  sum.stored += more.stored;
  sum.kinetic += more.kinetic;
  sum.lost += more.lost;
  sum.external += more.external;
  return sum;
}

/// What the plane does on the particles comes from its body once it has one.
double Compaction::external_work() const
{
  return Test::external_work() -
         (joined ? plate_plane().work - now.plane_work_gone : 0.);
}

Surroundings Compaction::surroundings() const
{
  const coupling::DeformableBody *stiff = tube;
  if (plate && plate->elastic()) // faster than any membrane
    stiff = plate->elastic();
  return {joined.get(), stiff, scene.setup.window, steps_in_move()};
}

FrameParts Compaction::frame_parts() const
{
  FrameParts parts{tube ? &tube->membrane() : nullptr, true};
  if (plate && plate->elastic())
    parts.bodies.push_back({"plate", [this](std::ostream &out)
                            { plate->elastic()->solid().write_vtu(out); }});
  return parts;
}

void Compaction::save(std::ostream &out, dem::StateExtent extent) const
{
  dem::write_value(out, now);
  dem::write_column(out, reports);
  pouring.save(out);
  Test::save(out, extent);
  if (joined)
    joined->save(out);
}

void Compaction::restore(std::istream &in)
{
  dem::read_value(in, now);
  dem::read_column(in, reports);
  pouring.restore(in);
  if (now.stage != Stage::filling && fills_by_own_steps())
    change_steps(parameters.time, step_limit().step);
  if (now.join_time > 0.)
    build_plate();
  if (now.release_time > 0.)
  {
    plate->release(now.release_time - now.join_time);
    if (now.stage == Stage::vibration)
      plate->start_exciter(now.vibration_start - now.release_time);
    if (parameters.container.is_flexible())
      build_tube();
  }
  Test::restore(in);
  if (joined)
    joined->restore(in);
  refuse_shorter("Vibration/duration", vibrated(),
                 parameters.vibration.duration);
}
} // namespace spall
