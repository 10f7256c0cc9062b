#include "triaxial/triaxial.h"

#include <dem/measure/assembly.h>
#include <dem/parallel/first_rank.h>

#include <cmath>
#include <sstream>

namespace spall
{
namespace
{
/// Of the way along one cycle of the mean cyclic motion.
constexpr double steps_in_cycle = 100.;
constexpr double rest_after_way = 1e-3; // [s]
} // namespace

Rewind Triaxial::rewind() const
{
  switch (plan.due())
  {
  case coupling::JumpStep::save_state:
    return Rewind::save_state;
  case coupling::JumpStep::restore_state:
    return Rewind::restore_state;
  default:
    return Rewind::none;
  }
}

void Triaxial::go_back(const std::function<void()> &restore_kept)
{
  const coupling::JumpPlan refused = plan;
  restore_kept();
  shorten_jump(refused);
}

/// The mean cyclic motion is that from here on.
void Triaxial::observe()
{
  with_whole([this](const dem::Engine &scene)
             { observed_from = coupling::pose_of(scene, *cell); });
}

void Triaxial::shorten_jump(const coupling::JumpPlan &refused)
{
  plan.shorten(refused);
  if (plan.observed() == 0)
    observe();
  std::ostringstream text;
  text << "cycle " << cycle() << ": a jump over " << refused.length()
       << " cycles was too far";
  watch.say(text.str());
}

coupling::SlowState Triaxial::slow_state() const
{
  return {cycle(), 1. - (cell->plate().height() - lower.z()) / start_height,
          100. * dem::abrasion(synchronized().particles(), ranks())};
}

/// The cycle to come stands for those that are skipped and for itself.
void Triaxial::begin_damage_cycles()
{
  engine().synchronize();
  if (plan.due() == coupling::JumpStep::save_state)
  {
    with_whole(
        [this](const dem::Engine &scene)
        {
          mean_motion = coupling::mean_motion_between(
              observed_from, coupling::pose_of(scene, *cell),
              static_cast<double>(parameters.cycle_jump.observed));
          coupling::calm_rattlers(scene, mean_motion);
        });
    dem::take_from_first_rank(
        ranks(),
        [this](std::ostream &out) { coupling::save(out, mean_motion); },
        [this](std::istream &in) { coupling::restore(in, mean_motion); });
  }
  plan.begin();
  schedule.skip(plan.skipping() * cycle_intervals);
  engine().set_time(engine().time() + plan.skipping() * period());
  engine().set_repetitions(plan.repetitions());
}

void Triaxial::after_sample()
{
  const std::int64_t interval = schedule.intervals() % cycle_intervals;
  if (interval == 0)
    end_cycle();
  else if (interval == cycle_intervals / 2 && plan.is_landing())
    extrapolate();
}

void Triaxial::end_cycle()
{
  engine().synchronize();
  engine().set_repetitions(1.);
  plan.take(slow_state());
  if (plan.observed() == 0)
    observe();
}

/// At the peak of the load, adds the strain of the skipped cycles by displacing
/// all particles along their mean cyclic motion, and takes time and
/// energies over.
void Triaxial::extrapolate()
{
  engine().synchronize();
  Sample before, after;
  add_energies(before);
  const double time = engine().time(), strain = slow_state().strain,
               missing = plan.missing_strain();
  engine().set_repetitions(0.);
  double moved = 0.;
  if (missing > 0.)
  {
    const double missing_cycles = missing / plan.strain_rate();
    const int n_steps =
        static_cast<int>(std::ceil(steps_in_cycle * missing_cycles));
    moved = coupling::move_along(mean_motion,
                                 {missing_cycles, n_steps, time_step()},
                                 *joined, *cell, engine());
    engine().set_local_damping(parameters.preparation.local_damping);
    hold_load(rest_after_way);
    engine().set_local_damping(parameters.time.local_damping);
  }
  engine().set_repetitions(1.);
  engine().set_time(time);
  add_energies(after);
  jump_work -= after.energy_residual - before.energy_residual;
  std::ostringstream text;
  text.precision(3);
  text << "cycle " << cycle() << ": jumped over " << plan.length()
       << " cycles, strain moved on by " << slow_state().strain - strain
       << " of " << missing << " in " << moved
       << " cycles of the mean cyclic motion";
  watch.say(text.str());
}

/// For so long [s].
void Triaxial::hold_load(double length)
{
  const double window = longest_step(),
               drive = cell->plate().state().last_drive;
  for (double time = 0.; time < length && stopped_by.empty(); time += window)
  {
    cell->set_drive(drive);
    exchange_window(window);
  }
  engine().synchronize();
}
} // namespace spall
