#include "test/test.h"

#include "case/parameter.h"
#include "errors.h"
#include "run/contact_point_events.h"
#include "run/first_rank.h"
#include "run/quantity_name.h"
#include "run/warnings.h"
#include "specimen/mesh_walls.h"

#include <dem/binary.h>
#include <dem/engine_boundaries.h>
#include <dem/measure/assembly.h>
#include <dem/packing/pouring.h>
#include <dem/parallel/distribution.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdio>
#include <sstream>
#include <stdexcept>
#include <utility>

namespace spall
{
double first_step(const Case &parameters, const dem::StepLimit &limit)
{
  if (parameters.time.step != StepRule::fixed)
    return parameters.time.safety * limit.step;
  if (parameters.time.fixed_step > limit.step)
    throw InputError(parameters.file + ": Time/fixed_step = " +
                     number_text(parameters.time.fixed_step) +
                     " s: must be at most " + number_text(limit.step) +
                     " s, set by: " + limit.reason);
  return parameters.time.fixed_step;
}

Test::Test(const Case &c, ShapeLibrary library,
           std::unique_ptr<dem::Engine> scene)
    : parameters(c), shapes(std::move(library)), owned_engine(std::move(scene)),
      is_shareable(needs_one_rank(c).empty()), limit(limit_at_setup()),
      watch(c.time, limit.step), step(first_step(c, limit))
{
}

Test::Test(const Case &c, ShapeLibrary library,
           std::unique_ptr<dem::Engine> scene, double its_step)
    : parameters(c), shapes(std::move(library)), owned_engine(std::move(scene)),
      is_shareable(needs_one_rank(c).empty()), limit(limit_at_setup()),
      watch(c.time, limit.step), step(its_step)
{
}

Test::Test(const Case &c, ShapeLibrary library,
           std::unique_ptr<dem::Engine> scene, const dem::StepLimit &its_limit,
           double its_step)
    : parameters(c), shapes(std::move(library)), owned_engine(std::move(scene)),
      is_shareable(needs_one_rank(c).empty()), limit(its_limit),
      watch(c.time, limit.step), step(its_step)
{
}

const dem::Engine &Test::synchronized() const
{
  owned_engine->synchronize();
  return *owned_engine;
}

dem::StepLimit Test::limit_at_setup() const
{
  dem::StepLimit longest;
  with_whole(
      [&](const dem::Engine &scene)
      {
        longest = limit_on_walls(
            parameters, scene.parameters(), scene.particles(),
            dem::critical_step(scene.parameters(), scene.particles()));
      });
  return {dem::of_first_rank(ranks(), longest.step),
          dem::of_first_rank(ranks(), longest.reason)};
}

void Test::gather_scene() const
{
  owned_engine->synchronize();
  if (!is_gathered() || copy)
    return;
  const Stopwatch clock;
  copy = std::make_unique<dem::Engine>(owned_engine->gathered());
  gathering += clock.seconds();
  ++n_copies;
}

const dem::Engine &Test::whole() const
{
  if (ranks().size() == 1)
    gather_scene();
  else if (ranks().rank() != 0 || (is_gathered() && !copy))
    throw std::logic_error("test: the scene is not gathered here");
  return is_gathered() ? *copy : *owned_engine;
}

void Test::with_whole(const std::function<void(const dem::Engine &)> &use) const
{
  gather_scene();
  on_first_rank(ranks(), [&] { use(whole()); });
}

void Test::with_all_particles(
    const std::function<void(const dem::ParticleSystem &)> &use) const
{
  if (const dem::Pouring *pouring = poured_by())
    return on_first_rank(
        ranks(),
        [&] { use(unplaced_particles(parameters, pouring->particles())); });
  with_whole([&](const dem::Engine &scene) { use(scene.particles()); });
}

std::int64_t Test::n_particles() const
{
  const dem::Pouring *pouring = poured_by();
  return pouring ? static_cast<std::int64_t>(pouring->n_particles())
                 : dem::total_particles(synchronized());
}

const dem::Ranks &Test::ranks() const
{
  return owned_engine->distribution().ranks();
}

void Test::advance()
{
  if (watch.is_due(engine().n_steps() / steps_in_move()))
    check_contacts();
  watch.note_used(step);
  move(step);
  if (!stopped_by.empty())
    throw coupling::GuardStop(std::exchange(stopped_by, {}));
}

void Test::check_contacts()
{
  watch.update(synchronized(), surroundings(), step);
  if (!watch.is_fixed())
    step = watch.state().longest;
}

void Test::begin_steps(const TimeParameters &rule, double cap)
{
  watch = StepWatch(rule, cap);
  step = watch.is_fixed() ? rule.fixed_step : watch.state().longest;
}

void Test::change_steps(const TimeParameters &rule, double cap)
{
  watch.follow(rule);
  watch.set_cap(cap);
  step = watch.is_fixed() ? rule.fixed_step : watch.state().longest;
}

void Test::say_prepared() const
{
  if (call_prepared)
    call_prepared();
}

void Test::exchange_window(coupling::Exchange &joined, double window)
try
{
  joined.advance_deferred(coupling::particles_of(engine(), shapes.series()),
                          window);
}
catch (const coupling::GuardStop &stop)
{
  stopped_by = stop.what();
}

void Test::stop_after(int)
{
  throw InputError("run: --until: a case of kind " + parameters.kind +
                   " has no turns or cycles");
}

std::vector<dem::BreakageEvent> Test::take_events()
{
  auto events = fresh_events();
  if (first_event.time < 0. && !events.empty())
    first_event = {events[0].time, events[0].force_before};
  removed.add(events, parameters.particle.density);
  return events;
}

std::array<double, 2> Test::particle_masses() const
{
  const dem::ParticleSystem &own = synchronized().particles();
  return dem::sum_particles<2>(engine(),
                               [&own](std::size_t i)
                               {
                                 return own.material[i] == 0
                                            ? std::array{own.solid_mass(i),
                                                         own.initial_mass[i]}
                                            : std::array{0., 0.};
                               });
}

double Test::abrasion_percent() const
{
  const auto [now, before] = particle_masses();
  return before > 0. ? 100. * (before - now) / before : 0.;
}

double Test::external_work() const
{
  const dem::EngineEnergy energy = synchronized().energy();
  return energy.work_of("planes") + energy.work_of("drum") +
         energy.work_of("mesh walls") + energy.gravity_work +
         body_energy().external;
}

EnergyBalance Test::energy_balance() const
{
  const dem::EngineEnergy e = synchronized().energy();
  const coupling::BodyEnergy bodies = body_energy();
  const double work = external_work();
  return {work,
          work - (e.kinetic + bodies.kinetic + e.elastic + bodies.stored +
                  e.friction + e.rolling + e.damping + bodies.lost +
                  e.breakage + e.non_conservative_work),
          e.non_conservative_work};
}

std::vector<Quantity> Test::boundary_row() const
{
  std::vector<Quantity> all;
  for (const auto &[name, value] : boundary_quantities(
           synchronized(), named_boundaries(), moment_point(), removed))
    all.push_back({name, value});
  return all;
}

std::vector<Quantity> Test::row() const
{
  std::vector<Quantity> all = {{"time_s", engine().time()}};
  for (const Quantity &one : measured())
    all.push_back(one);
  for (const Quantity &one : boundary_row())
    all.push_back(one);
  const dem::EngineEnergy e = synchronized().energy();
  const coupling::BodyEnergy bodies = body_energy();
  const EnergyBalance balance = energy_balance();
  const std::vector<Quantity> common = {
      {"laa_percent", abrasion_percent(), true},
      {"n_events_1", static_cast<double>(engine().n_events()), true},
      {"overlap_over_radius_1", dem::total_overlaps(engine()).recent},
      {"external_work_J", balance.external_work},
      {"kinetic_energy_J", e.kinetic + bodies.kinetic},
      {"elastic_energy_J", e.elastic + bodies.stored},
      {"friction_dissipation_J", e.friction},
      {"rolling_dissipation_J", e.rolling},
      {"damping_dissipation_J", e.damping + bodies.lost},
      {"breakage_energy_J", e.breakage},
      {"non_conservative_work_J", balance.non_conservative_work},
      {"energy_residual_J", balance.residual}};
  all.insert(all.end(), common.begin(), common.end());
  return all;
}

std::string Test::live_numbers()
{
  std::string numbers;
  for (const Quantity &one : row())
  {
    if (!one.is_live)
      continue;
    const QuantityName name = quantity_name(one.name);
    char text[80];
    std::snprintf(text, sizeof text, "%s%s %.4g%s%s",
                  numbers.empty() ? "" : ", ", name.words.c_str(), one.value,
                  name.unit == "–" ? "" : " ",
                  name.unit == "–" ? "" : name.unit.c_str());
    numbers += text;
  }
  return numbers;
}

void Test::add_clocks(std::map<std::string, double> &seconds) const
{
  seconds["step_watch"] = watch.seconds();
  if (gathering > 0.)
    seconds["gathering"] = gathering;
}

std::vector<std::string> Test::warnings() const
{
  std::vector<std::string> all;
  add_overlap_warning(engine(), all);
  add_step_warning(parameters.time, watch.state(), all);
  add_energy_warning(reported_balance(), all);
  return all;
}

void Test::summarise(nlohmann::ordered_json &summary) const
{
  const dem::ParticleSystem &own = synchronized().particles();
  const auto [n, n_breakable] = dem::sum_particles<2>(
      engine(),
      [&own](std::size_t i)
      {
        return std::array{own.material[i] == 0 ? 1. : 0.,
                          own.is_breakable[i] == 1 ? 1. : 0.};
      });
  summary["n_particles"] = static_cast<std::int64_t>(n);
  summary["n_breakable"] = static_cast<std::int64_t>(n_breakable);
  summary["solid_volume_m3"] = dem::solid_volume(own, ranks());
  summary["time_step_s"] = time_step();
  const StepRecord &steps = watch.state();
  if (parameters.time.step == StepRule::fixed)
    summary["step_over_limit_1"] = steps.worst_share;
  else
  {
    summary["shortest_step_s"] = steps.shortest_used;
    summary["longest_step_s"] = steps.longest_used;
  }
  summary["n_steps"] = engine().n_steps();
  summary["n_rebuilds"] = engine().n_rebuilds();
  summary["laa_percent"] = abrasion_percent();
  summary["n_events"] = engine().n_events();
  summary["n_refused_events"] = engine().n_refused_events();
  summary["overlap_over_radius_1"] = dem::total_overlaps(engine()).largest;
  for (const Quantity &one : boundary_row())
    summary["walls"][one.name] = one.value;
  removed.summarise(engine(), named_boundaries(), summary);
  add_contact_point_events(engine(), summary);
  if (first_event.time >= 0.)
  {
    summary["first_event_force_N"] = first_event.force;
    summary[std::string("first_event_") + progress_column()] =
        progress_at(first_event.time);
  }
}

void Test::save(std::ostream &out, dem::StateExtent extent) const
{
  dem::write_value(out, step);
  dem::write_value(out, watch.state());
  save_breakage(out);
  save_particles(out, extent);
}

void Test::save_particles(std::ostream &out, dem::StateExtent extent) const
{
  const bool has_order = is_gathered() && synchronized().is_shareable();
  synchronized().save(out, shapes.series(),
                      has_order ? extent : dem::StateExtent::rank);
}

void Test::restore(std::istream &in)
{
  dem::read_value(in, step);
  StepRecord record;
  dem::read_value(in, record);
  watch.set_state(record);
  restore_breakage(in);
  engine().restore(in, shapes.series());
}

void Test::save_breakage(std::ostream &out) const
{
  dem::write_value(out, first_event);
  removed.save(out);
}

void Test::restore_breakage(std::istream &in)
{
  dem::read_value(in, first_event);
  removed.restore(in);
}

std::string needs_one_rank(const Case &parameters)
{
  const TestKind *kind = find_kind(parameters.kind);
  if (!kind || !kind->runs_on_many_ranks)
    return "Case/kind = " + parameters.kind;
  if (parameters.breakage.memory == dem::FactorMemory::patch)
    return "Breakage/memory = patch";
  return kind->needs_one_rank ? kind->needs_one_rank(parameters)
                              : std::string();
}

void require_shareable(const dem::Ranks &ranks, const Case &parameters)
{
  const std::string what = needs_one_rank(parameters);
  if (ranks.size() > 1 && !what.empty())
    throw InputError(parameters.file + ": " + what +
                     ": runs on one MPI rank alone, not on " +
                     std::to_string(ranks.size()) + ": use --threads");
}

std::unique_ptr<Test> make_test(const Case &parameters)
{
  std::unique_ptr<Test> test = find_kind(parameters.kind)->make(parameters);
  for (const NamedBoundary &one : test->named_boundaries())
    for (const WallSection &wall : parameters.walls)
      if (wall.name == one.name)
        throw InputError(parameters.file + ": " + wall.section() +
                         ": tests of kind " + parameters.kind +
                         " have a boundary of this name: choose another");
  return test;
}
} // namespace spall
