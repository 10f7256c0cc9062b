#include "triaxial/triaxial.h"

#include "run/digest.h"
#include "test/checkpoint.h"
#include "triaxial/preparation.h"

#include <dem/binary.h>
#include <dem/engine_boundaries.h>
#include <dem/measure/assembly.h>
#include <dem/measure/totals.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

namespace spall
{
namespace
{
dem::ServoParameters servo_parameters(const Case &c)
{
  const dem::Vec3 size = nominal_size(c.specimen);
  return {c.boundary.servo_response_time, c.preparation.wall_speed,
          size / size.maxCoeff(), c.boundary.servo_yielding,
          c.boundary.servo_dead_band};
}

/// Collective [kg].
double lightest_particle(const dem::Engine &engine)
{
  return -dem::largest_of_particles(
      engine, -std::numeric_limits<double>::infinity(),
      [&engine](std::size_t i) { return -engine.particles().mass(i); });
}
} // namespace

Triaxial::Triaxial(const Case &c) : Triaxial(c, make_specimen(c)) {}

Triaxial::Triaxial(const Case &c, Specimen specimen)
    : Test(c, std::move(specimen.shapes), std::move(specimen.engine), 0.),
      box(specimen.walls), servo(box, servo_parameters(c)),
      setup(choose_step(c, step_limit(), lightest_particle(synchronized()))),
      scaling(of_whole([](const dem::Engine &scene)
                       { return dem::density_scaling_of(scene.particles()); })),
      follower(load_path_of(c), c.loading.confining_pressure),
      cycle_intervals(intervals_in(follower.period())),
      n_cycles(follower.path().n_cycles()), plan(c.cycle_jump, n_cycles),
      cycles(c.loading.form, follower.path()),
      rest(c.preparation.unbalanced_ratio)
{
  watch = StepWatch(step_rule(), step_limit().step);
  Digest digest;
  digest.add(preparation_text());
  preparation.hash = digest.value();
  enter(Stage::preparation);
  engine().set_breaking(false);
  for (int d = 0; d < 3; ++d)
    servo.follow(d, c.preparation.pressure);
  follower.aim_at(c.preparation.pressure);
}

std::string Triaxial::preparation_text() const
{
  return specimen_text(parameters, shapes);
}

void Triaxial::advance()
{
  if (now == Stage::done)
    return;
  if (now == Stage::loading && follower.is_over())
    begin_next_stage();
  if (plan.due() == coupling::JumpStep::save_state ||
      plan.due() == coupling::JumpStep::damage)
    begin_damage_cycles();
  settle_step();
  const bool is_loading = now == Stage::loading;
  move(time_step());
  if (is_loading && schedule.is_on_sample())
    after_sample();
  note_due();
  if (!stopped_by.empty())
    throw coupling::GuardStop(std::exchange(stopped_by, {}));
}

void Triaxial::move(double)
{
  switch (now)
  {
  case Stage::preparation:
    return prepare();
  case Stage::consolidation:
    return consolidate();
  case Stage::loading:
    load();
    return follow_probe();
  case Stage::done:
    return;
  }
}

void Triaxial::enter(Stage next)
{
  now = next;
  in_stage = 0;
  watch.follow(step_rule());
  const double longest = longest_step();
  if (next == Stage::preparation)
    return schedule.begin(std::numeric_limits<double>::infinity(), longest);
  if (next == Stage::loading)
    return schedule.begin(period() / static_cast<double>(cycle_intervals),
                          longest);
  // Consolidation: two halves, or as many steps as come near to its length.
  const double length = parameters.loading.consolidation_time;
  stage_intervals =
      is_fixed() ? std::max<std::int64_t>(2, std::llround(length / longest))
                 : 2;
  schedule.begin(is_fixed() ? longest : std::max(0.5 * length, longest),
                 longest);
}

bool Triaxial::refines_membrane() const
{
  return parameters.boundary.lateral == Lateral::membrane &&
         parameters.boundary.refined == MembraneRefinement::pressed;
}

/// With the quads halved that particles press on when it takes over.
fem::SurfaceMesh Triaxial::side_mesh() const
{
  const fem::SurfaceMesh mesh = lateral_mesh(parameters, lower, upper);
  return pressed.empty() ? mesh : fem::halve_quads(mesh, pressed);
}

void Triaxial::build_cell()
{
  std::optional<fem::Membrane> membrane;
  if (parameters.boundary.lateral == Lateral::membrane)
  {
    membrane.emplace(
        coupling::tube_between_rims(parameters.membrane, side_mesh()));
    watch.forget_membrane();
  }
  const CouplingParameters &c = parameters.coupling;
  const coupling::BodySteps steps =
      membrane ? coupling::BodySteps{c.is_body_implicit, c.body_steps}
               : coupling::BodySteps{};
  auto body = std::make_unique<coupling::TriaxialCell>(
      parameters.boundary.plate_mass, upper.z(), std::move(membrane), steps);
  cell = body.get();
  watch.set_cap(setup.cap);
  joined = std::make_unique<coupling::Exchange>(
      c.exchange_rules(parameters.boundary.lateral));
  std::unique_ptr<coupling::InterfaceAdapter> adapter = coupling::adapter_of(
      *cell, box.planes[2][1], parameters.membrane_contact, engine());
  joined->add(std::move(body), std::move(adapter), engine());
}

/// The servo walls go along with the particles.
coupling::CoupledParticles Triaxial::particles()
{
  return {engine(),
          [this](double time_step)
          {
            servo.update(engine(), time_step);
            engine().advance_deferred(time_step);
          },
          [this](std::ostream &out)
          {
            engine().save(out, shapes.series());
            servo.save(out);
          },
          [this](std::istream &in)
          {
            engine().restore(in, shapes.series());
            servo.restore(in);
          }};
}

void Triaxial::step_boundaries()
{
  exchange_window(schedule.step());
  schedule.count();
  ++in_stage;
}

void Triaxial::exchange_window(double window)
{
  if (cell->has_membrane())
    cell->set_pressure(pressure);
  try
  {
    joined->advance_deferred(particles(), window);
  }
  // Once the step has been counted.
  catch (const coupling::FoldStop &stop)
  {
    stopped_by = stop.what() + std::string("; larger quads, a higher "
                                           "Membrane/tension or a longer "
                                           "Loading/consolidation_time may "
                                           "prevent it");
  }
  catch (const coupling::GuardStop &stop)
  {
    stopped_by = stop.what();
  }
}

const dem::Plane &Triaxial::top_plane() const
{
  return dem::planes(engine())[box.planes[2][1]];
}

double Triaxial::lateral_stress() const
{
  const dem::Vec3 on_planes = dem::box_stress(engine(), box);
  return 0.5 * (on_planes.x() + on_planes.y()) + (membrane() ? pressure : 0.);
}

/// Mean section of the specimen, that of the plate when loading began [m^2].
double Triaxial::section() const
{
  return now < Stage::loading
             ? area
             : area * (volume() / start_volume) * start_height /
                   (cell->plate().height() - lower.z());
}

/// Of walls and membrane alone, which every rank has.
double Triaxial::volume() const
{
  return coupling::enclosed_volume(enclosed(engine()));
}

coupling::StressBalance Triaxial::stress_balance(const dem::Engine &scene) const
{
  const dem::Vec3 base(upper.x(), upper.y(), lower.z());
  return coupling::stress_balance(
      enclosed(scene), {pressure, area, cell->plate().height() - lower.z(),
                        0.5 * (lower + base)});
}

Sample Triaxial::sample(double roundness) const
{
  const dem::ContactNetwork network = dem::contact_network(synchronized());
  Sample s;
  s.time = engine().time();
  s.stage = std::min(2., static_cast<double>(now));
  s.cycle = cycle();
  s.axial_stress = now == Stage::preparation
                       ? dem::box_stress(engine(), box).z()
                       : top_plane().force.z() / section();
  s.lateral_stress = lateral_stress();
  const dem::Mat3 in_membrane =
      coupling::membrane_stress({engine(), walls(), membrane()});
  s.membrane_axial_stress = coupling::axial(in_membrane);
  s.membrane_lateral_stress = coupling::lateral(in_membrane);
  if (now >= Stage::loading)
  {
    s.axial_strain = 1. - (cell->plate().height() - lower.z()) / start_height;
    s.volumetric_strain = 1. - volume() / start_volume;
  }
  s.porosity = porosity();
  s.laa = 100. * dem::abrasion(engine().particles(), ranks());
  s.coordination_number = network.coordination_number;
  s.mean_contact_force = network.mean_force;
  s.roundness = roundness;
  s.n_contacts = static_cast<double>(network.n_contacts);
  s.n_events = static_cast<double>(engine().n_events());
  s.unbalanced_force_ratio = dem::unbalanced_force_ratio(engine());
  s.overlap_over_radius = dem::total_overlaps(engine()).recent;
  const dem::Vec3 on_planes = dem::box_stress(engine(), box);
  s.x_stress = on_planes.x() + (membrane() ? pressure : 0.);
  s.y_stress = on_planes.y() + (membrane() ? pressure : 0.);
  s.loading_stage =
      now < Stage::loading ? 0. : static_cast<double>(follower.index() + 1);
  s.axial_target = follower.axial_target();
  s.lateral_target = 0.5 * (follower.side_target(0) + follower.side_target(1));
  add_energies(s);
  return s;
}

void Triaxial::add_energies(Sample &s) const
{
  const dem::EngineEnergy energy = synchronized().energy();
  s.external_work = energy.work_of("planes") + energy.work_of("drum") +
                    energy.work_of("mesh walls") + energy.cell_work +
                    energy.gravity_work;
  s.kinetic_energy = energy.kinetic;
  s.elastic_energy = energy.elastic;
  s.friction = energy.friction;
  s.rolling = energy.rolling;
  s.damping = energy.damping;
  s.breakage = energy.breakage;
  s.non_conservative_work = energy.non_conservative_work;
  if (cell)
  {
    const double top_work = top_plane().work;
    const coupling::BodyEnergy closed = cell->energy();
    s.external_work += closed.external - (top_work - plane_work_gone);
    s.kinetic_energy += closed.kinetic;
    s.damping += closed.lost;
    s.membrane_strain_energy = closed.stored;
  }
  s.external_work += jump_work;
  s.energy_residual =
      s.external_work - (s.kinetic_energy + s.elastic_energy + s.friction +
                         s.rolling + s.damping + s.breakage +
                         s.non_conservative_work + s.membrane_strain_energy);
}

void Triaxial::save(std::ostream &out, dem::StateExtent extent) const
{
  dem::write_value(out, now);
  follower.save(out);
  dem::write_value(out, in_stage);
  dem::write_value(out, parameters.time);
  dem::write_value(out, cycle_intervals);
  dem::write_value(out, schedule);
  dem::write_value(out, stage_intervals);
  dem::write_value(out, watch.state());
  dem::write_value(out, probe);
  dem::write_value(out, preparation);
  dem::write_value(out, consolidation);
  dem::write_value(out, is_dense);
  dem::write_value(out, lower);
  dem::write_value(out, upper);
  if (refines_membrane())
    dem::write_column(out, pressed);
  for (const double value :
       {area, pressure, plane_work_gone, start_height, start_volume, jump_work})
    dem::write_value(out, value);
  dem::write_value(out, start_size);
  dem::write_value(out, plan);
  coupling::save(out, observed_from);
  coupling::save(out, mean_motion);
  save_particles(out, extent);
  servo.save(out);
  if (joined)
    joined->save(out);
  save_breakage(out);
  dem::write_value(out, recorded);
  cycles.save(out);
}

void Triaxial::restore(std::istream &in)
{
  dem::read_value(in, now);
  follower.restore(in);
  cycle_intervals = intervals_in(follower.period());
  dem::read_value(in, in_stage);
  TimeParameters time_then;
  std::int64_t intervals_then = 0;
  dem::read_value(in, time_then);
  watch.follow(step_rule()); // of the stage then
  dem::read_value(in, intervals_then);
  dem::read_value(in, schedule);
  dem::read_value(in, stage_intervals);
  StepRecord record;
  dem::read_value(in, record);
  dem::read_value(in, probe);
  dem::read_value(in, preparation);
  dem::read_value(in, consolidation);
  dem::read_value(in, is_dense);
  dem::read_value(in, lower);
  dem::read_value(in, upper);
  if (refines_membrane())
    dem::read_column(in, pressed);
  for (double *value : {&area, &pressure, &plane_work_gone, &start_height,
                        &start_volume, &jump_work})
    dem::read_value(in, *value);
  dem::read_value(in, start_size);
  dem::read_value(in, plan);
  plan.set_end(follower.path().n_cycles());
  coupling::restore(in, observed_from);
  coupling::restore(in, mean_motion);
  const bool has_boundaries = now > Stage::preparation;
  if (has_boundaries && !joined) // a probe goes back with the one it has
    build_cell();
  watch.set_state(record); // a new membrane would have it evaluated again
  engine().restore(in, shapes.series());
  servo.restore(in);
  if (joined)
    joined->restore(in);
  restore_breakage(in);
  dem::read_value(in, recorded);
  cycles.restore(in);
  resume_schedule(time_then, intervals_then);
  if (now < Stage::loading)
    return;
  follower.update_end(cycles_of_stage());
  if (now == Stage::done && !is_at_end())
    now = Stage::loading;
  refuse_shorter(parameters.loading.form == LoadForm::path ? "cycles_1"
                                                           : "Loading/cycles",
                 cycles_of_stage(), follower.stage().n_cycles());
}
} // namespace spall
