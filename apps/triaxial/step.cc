#include "triaxial/triaxial.h"

#include <dem/engine_boundaries.h>

#include <chrono>
#include <sstream>
#include <stdexcept>
#include <utility>

namespace spall
{
namespace
{
/// Steps of the coarse run of a probe: some periods of the stiffest contacts.
constexpr std::int64_t probe_steps = 32;

/// Runs `work` and adds its wall-clock to `seconds`.
template <class Work>
void timed(double &seconds, const Work &work)
{
  using Clock = std::chrono::steady_clock;
  const auto start = Clock::now();
  work();
  seconds += std::chrono::duration<double>(Clock::now() - start).count();
}
} // namespace

bool Triaxial::is_fixed() const
{
  return parameters.time.step == StepRule::fixed;
}

/// How the present stage takes its steps: the preparation may have its own.
TimeParameters Triaxial::step_rule() const
{
  return now == Stage::preparation
             ? parameters.time.preparing(parameters.preparation.safety)
             : parameters.time;
}

/// Of the particles, between two exchanges with what closes the specimen.
int Triaxial::steps_in_window() const
{
  return parameters.coupling.exchange_rules(parameters.boundary.lateral)
      .particle_steps;
}

/// Of the particles, in a step of the schedule.
int Triaxial::steps_in_move() const
{
  return now == Stage::preparation ? 1 : steps_in_window();
}

double Triaxial::time_step() const
{
  return schedule.step() / steps_in_move();
}

Surroundings Triaxial::surroundings() const
{
  return {joined.get(), cell && cell->has_membrane() ? cell : nullptr,
          setup.window, steps_in_move()};
}

double Triaxial::exchange_gain() const
{
  return joined ? joined->gain(synchronized(), schedule.step()) : 0.;
}

/// Of the schedule: of particles in the preparation, of windows from then on.
double Triaxial::longest_step() const
{
  const int n = steps_in_move();
  if (watch.is_fixed())
    return n * setup.step;
  const double allowed = n * watch.state().longest;
  return probe.longest > 0. ? std::min(allowed, probe.longest) : allowed;
}

/// What is due before a step: a check of the contacts, a probe.
void Triaxial::settle_step()
{
  if (watch.is_due(engine().n_steps() / steps_in_move()))
  {
    watch.update(synchronized(), surroundings(), time_step());
    // The steps of a probe stay as they are: they are to meet.
    if (!watch.is_fixed() && probe.fine_left == 0)
      schedule.replan(longest_step());
  }
  if (now != Stage::loading)
    return;
  if (parameters.time.step == StepRule::error && schedule.is_on_sample())
    start_probe();
  watch.note_used(time_step());
}

/// A run may continue with other steps where a load cycle ends.
void Triaxial::resume_schedule(const TimeParameters &then,
                               std::int64_t intervals_then)
{
  if (then.step == parameters.time.step && cycle_intervals == intervals_then &&
      (!is_fixed() || then.fixed_step == parameters.time.fixed_step))
    return;
  if (now < Stage::loading || !schedule.is_on_sample() ||
      schedule.intervals() % intervals_then != 0)
    throw std::runtime_error(
        "is not at the end of a load cycle: Time/step, Time/fixed_step and "
        "(rules stable and error) Output/samples_per_cycle must be as before");
  probe = {};
  watch.set_state(StepWatch(parameters.time, setup.cap).state());
  watch.update(synchronized(), surroundings(), setup.step);
  schedule.begin(period() / static_cast<double>(cycle_intervals),
                 longest_step(),
                 schedule.intervals() / intervals_then * cycle_intervals);
}

/// Runs ahead with the present step, comes back, and halves the step.
void Triaxial::start_probe()
{
  probe.n_coarse = std::min(probe_steps, schedule.steps_to_sample());
  probe.coarse_step = schedule.step();
  probe.coarse = probe.fine = {};
  engine().synchronize();
  Sample energies;
  add_energies(energies);
  probe.residual_start = energies.energy_residual;
  probe.work_start = energies.external_work;
  // Restoring drops the events that are not taken yet.
  held_events = fresh_events();
  std::stringstream state(std::ios::in | std::ios::out | std::ios::binary);
  timed(probing, [&] { save(state, dem::StateExtent::rank); });
  coupling::ProbeWindow coarse;
  for (std::int64_t k = 0; k < probe.n_coarse; ++k)
  {
    load();
    gather(coarse);
  }
  engine().synchronize();
  close_window(coarse);
  timed(probing, [&] { restore(state); });
  stopped_by.clear(); // if at all, the run comes there itself
  probe.coarse = coarse;
  probe.fine_left = 2 * probe.n_coarse;
  probe.n_extra_steps += probe.n_coarse;
  schedule.replan(0.5 * probe.coarse_step);
}

/// After a step: the finer run of a probe continues, or is compared.
void Triaxial::follow_probe()
{
  if (probe.fine_left == 0)
    return;
  if (--probe.fine_left % 2 == 0)
    gather(probe.fine);
  if (probe.fine_left > 0)
    return;
  engine().synchronize();
  close_window(probe.fine);
  const double before = longest_step();
  const double duration =
      static_cast<double>(probe.n_coarse) * probe.coarse_step;
  adapt({parameters.time.force_tolerance, parameters.time.energy_tolerance},
        {duration, watch.state().longest, probe.fine.stored / period(),
         static_cast<int>(cycle_intervals)},
        probe);
  // The limit of the contacts may have come down while the probe ran.
  schedule.replan(longest_step());
  const double change = longest_step() / before;
  const coupling::StepErrors errors = errors_of(probe);
  if (change > 0.8 && change < 1.25)
    return;
  std::ostringstream text;
  text.precision(3);
  text << "cycle " << cycle() << ": step " << longest_step()
       << " s: errors of a cycle: force " << errors.force << ", energy "
       << errors.energy;
  watch.say(text.str());
}

void Triaxial::gather(coupling::ProbeWindow &window) const
{
  const dem::Engine &particles = engine();
  window.axial += top_plane().force.z() + cell->rim_reaction();
  if (membrane())
    for (const dem::Vec3 &load : dem::surface(particles).load)
      window.lateral += load.norm();
  else if (box.is_round())
    window.lateral += dem::drum(particles).thrust;
  else if (particles.cell().is_there())
    window.lateral -= 2. * particles.cell().force.sum(); // of two faces each
  else
    for (std::size_t d = 0; d < 2; ++d)
      for (const std::size_t plane : box.planes[d])
        window.lateral += dem::planes(particles)[plane].force.norm();
}

void Triaxial::close_window(coupling::ProbeWindow &window) const
{
  Sample energies;
  add_energies(energies);
  window.residual = energies.energy_residual - probe.residual_start;
  window.work = std::abs(energies.external_work - probe.work_start);
  window.stored = energies.elastic_energy + energies.membrane_strain_energy;
}

std::vector<dem::BreakageEvent> Triaxial::fresh_events()
{
  auto events = std::exchange(held_events, {});
  const auto take = [&events](const std::vector<dem::BreakageEvent> &more)
  { events.insert(events.end(), more.begin(), more.end()); };
  if (joined)
    take(joined->take_events());
  take(engine().take_events());
  return events;
}
} // namespace spall
