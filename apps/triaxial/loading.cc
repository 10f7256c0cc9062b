// The loading: stages of the loading path, one after the other.
#include "case/parameter.h"
#include "run/warnings.h"
#include "triaxial/triaxial.h"

#include <dem/engine_boundaries.h>
#include <dem/measure/assembly.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace spall
{
namespace
{
/// Checks of the end of a stage, evenly over a cycle.
constexpr std::int64_t checks_per_cycle = 50;

/// Loading begins out of balance where a stress is off by more than this share
/// of the confining pressure.
constexpr double balance_limit = 0.05;

/// Largest excess of the axial stress over what is asked for, over that.
constexpr double peak_limit = 0.1;
} // namespace

void Triaxial::stop_after(int cycles_asked)
{
  n_cycles = std::min(cycles_asked, follower.path().n_cycles());
}

double Triaxial::period() const
{
  return is_fixed() ? static_cast<double>(cycle_intervals) * setup.step *
                          steps_in_window()
                    : follower.period();
}

/// Sampling intervals of a cycle of this length [s].
std::int64_t Triaxial::intervals_in(double cycle_period) const
{
  return is_fixed() ? std::max<std::int64_t>(
                          1, std::llround(cycle_period /
                                          (setup.step * steps_in_window())))
                    : parameters.output.samples_per_cycle;
}

double Triaxial::cycles_of_stage() const
{
  return (static_cast<double>(schedule.intervals()) + schedule.share_done()) /
         static_cast<double>(cycle_intervals);
}

double Triaxial::cycle() const
{
  if (now < Stage::loading)
    return 0.;
  const bool counts_as_one = follower.is_over() && !follower.stage().has_wave();
  return follower.cycles_before() + (counts_as_one ? 1. : cycles_of_stage());
}

bool Triaxial::is_at_end() const
{
  return is_complete() || (schedule.intervals() % cycle_intervals == 0 &&
                           schedule.is_on_sample() && cycle() >= n_cycles);
}

/// Whether of so many instants in a cycle, evenly, one is this interval.
bool Triaxial::is_interval_due(std::int64_t times) const
{
  const std::int64_t n = cycle_intervals, interval = schedule.intervals();
  return times > 0 && (interval * times) / n != ((interval - 1) * times) / n;
}

/// At the end of the coming step.
StagePosition Triaxial::stage_position() const
{
  const auto n = static_cast<double>(cycle_intervals);
  const double share = schedule.share_after_step();
  return {
      (static_cast<double>(schedule.intervals()) + share) / n,
      (static_cast<double>(schedule.intervals() % cycle_intervals) + share) / n,
      cycles_of_stage(), schedule.step()};
}

/// Without volume and section unless they are asked for: those of a membrane
/// are a sum over its quads.
LoadMeasures Triaxial::load_measures(bool with_volume) const
{
  const fem::RigidPlate &plate = cell->plate();
  const dem::Vec3 size = dem::box_size(engine(), box),
                  stress = dem::box_stress(engine(), box);
  const double confining = membrane() ? pressure : 0.;
  LoadMeasures m;
  m.time = engine().time();
  m.height = plate.height() - lower.z();
  m.axial_strain = 1. - m.height / start_height;
  m.plate_speed = -plate.velocity();
  for (int d = 0; d < 2; ++d)
  {
    m.side_stress[static_cast<std::size_t>(d)] = stress[d] + confining;
    m.side_strain[static_cast<std::size_t>(d)] = 1. - size[d] / start_size[d];
  }
  if (!with_volume)
    return m;
  m.volume = volume();
  m.axial_stress = top_plane().force.z() / section();
  return m;
}

/// The next stage of the path; the first one follows the consolidation.
void Triaxial::begin_stage()
{
  LoadMeasures measures = load_measures(true);
  const std::size_t next = follower.runs().size();
  const bool is_over_first = follower.path().stages[next].is_over_first_section;
  measures.drive_stress =
      -cell->plate().state().last_drive / (is_over_first ? area : section());
  const bool was_driven = follower.is_driven();
  follower.begin(measures, cycle());
  if (follower.is_driven() && !was_driven)
    hold_plate();
  cycle_intervals = intervals_in(follower.period());
  follower.round_period(period());
}

void Triaxial::begin_next_stage()
{
  begin_stage();
  schedule.begin(period() / static_cast<double>(cycle_intervals),
                 longest_step());
  std::ostringstream text;
  text.precision(4);
  text << "stage " << follower.index() + 1 << " of "
       << follower.path().stages.size() << ", " << follower.stage().name
       << ": begins at " << engine().time() << " s, cycle " << cycle();
  watch.say(text.str());
}

void Triaxial::load()
{
  const LoadStage &stage_now = follower.stage();
  const bool follows_stresses = follower.path().needs_stresses();
  const LoadMeasures measures = load_measures(
      follows_stresses || stage_now.rule == SideRule::constant_volume);
  const StagePosition end = stage_position();
  if (follows_stresses)
    follower.observe(measures, schedule.step(),
                     parameters.boundary.servo_response_time);
  follower.aim(end);
  load_sides(measures);
  load_plate(measures, end);
  step_boundaries();
  end_interval();
}

void Triaxial::load_plate(const LoadMeasures &measures,
                          const StagePosition &end)
{
  if (follower.is_driven())
    return cell->set_acceleration(
        follower.plate_acceleration(measures, end, start_height));
  const bool is_over_first = follower.stage().is_over_first_section;
  cell->set_drive(-follower.axial_target() *
                  (is_over_first ? area : section()));
}

void Triaxial::load_sides(const LoadMeasures &measures)
{
  if (membrane())
  {
    pressure = follower.side_target(0);
    return;
  }
  for (int d = 0; d < 2; ++d)
    if (follower.is_side_moved(d))
      servo.move(d, follower.side_rate(
                        d, measures, parameters.boundary.servo_response_time));
    else
      servo.follow(d, follower.side_target(d));
}

/// Where a sampling interval ends, the stage may end, and with it the loading.
void Triaxial::end_interval()
{
  if (!schedule.is_on_sample())
    return;
  const bool is_end_of_cycle = schedule.intervals() % cycle_intervals == 0;
  const LoadStage &stage_now = follower.stage();
  if (stage_now.has_end() &&
      (stage_now.has_wave() ? is_end_of_cycle
                            : is_interval_due(checks_per_cycle)))
  {
    engine().synchronize();
    follower.end_interval(load_measures(false), cycles_of_stage(),
                          stage_now.until_unbalanced
                              ? dem::unbalanced_force_ratio(synchronized())
                              : 1.);
  }
  else
    follower.update_end(cycles_of_stage());
  if (is_at_end())
    now = Stage::done;
}

/// A plate that is driven starts from rest.
void Triaxial::hold_plate()
{
  fem::RigidPlate::State state = cell->plate().state();
  state.speed = 0.;
  state.last_drive = -state.last_reaction;
  cell->set_plate(state);
}

/// Stresses where loading begins, against the confining pressure.
void Triaxial::add_balance_warning(std::vector<std::string> &all) const
{
  const Sample &start = recorded.loading_start;
  const double asked = parameters.loading.confining_pressure;
  std::vector<std::pair<const char *, double>> stresses = {
      {"axial", recorded.plate_stress}};
  if (parameters.boundary.lateral != Lateral::membrane)
    stresses.insert(stresses.end(),
                    {{"x", start.x_stress}, {"y", start.y_stress}});
  for (const auto &[name, stress] : stresses)
  {
    if (std::abs(stress / asked - 1.) <= balance_limit)
      continue;
    std::ostringstream text;
    text.precision(3);
    text << "loading begins out of balance: " << name << " stress " << stress
         << " Pa where Loading/confining_pressure = " << number_text(asked)
         << ": a smaller Loading/consolidation_stress_tolerance or a longer "
            "consolidation_time may help";
    all.push_back(text.str());
  }
}

/// A plate that is heavy for the specimen swings on it.
void Triaxial::add_peak_warning(std::vector<std::string> &all) const
{
  const LoadingParameters &l = parameters.loading;
  const double asked = l.confining_pressure + l.amplitude;
  if (l.form != LoadForm::haversine ||
      recorded.peak_axial_stress <= (1. + peak_limit) * asked)
    return;
  std::ostringstream text;
  text.precision(3);
  text << "the largest axial stress was " << recorded.peak_axial_stress
       << " Pa where Loading asks for " << asked
       << ": the acceleration of the plate adds to the load, less with a "
          "smaller Boundary/plate_mass or Loading/frequency";
  all.push_back(text.str());
}

std::vector<std::string> Triaxial::warnings() const
{
  std::vector<std::string> all = Test::warnings();
  if (recorded.loading_start.loading_stage > 0.)
    add_balance_warning(all);
  add_peak_warning(all);
  const std::vector<StageRun> &runs = follower.runs();
  for (std::size_t k = 0; k < runs.size(); ++k)
    if (const LoadStage &stage_k = follower.path().stages[k];
        stage_k.has_end() && runs[k].is_over != 0 && runs[k].is_met == 0)
      all.push_back("stage " + std::to_string(k + 1) +
                    " of the loading path, " + stage_k.name +
                    ": ended by its length before its end condition was met");
  const Sample &end = recorded.last;
  add_jump_warning(plan.account(), parameters.cycle_jump.tolerance,
                   {end.cycle, end.axial_strain, end.laa}, all);
  return all;
}
} // namespace spall
