#include "triaxial/load_follower.h"

#include "case/parameter.h"
#include "run/binary_text.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace spall
{
namespace
{
constexpr double none = std::numeric_limits<double>::quiet_NaN();

/// A plate that is driven gets up to its speed in this share of its time, as a
/// wave would run ahead of a jump.
constexpr double start_share = 0.01;

/// A plate is not stopped in fewer steps.
constexpr double least_steps = 20.;

/// Of a stage that begins at its target [s].
constexpr double least_length = 1e-6;

/// Running means reach back over this share of the response time.
constexpr double mean_share = 0.2;

/// Whether a value has come from `from` to `goal`.
bool has_reached(double from, double now, double goal)
{
  return (goal - from) * (goal - now) <= 0.;
}
} // namespace

LoadFollower::LoadFollower(LoadPath path, double confining_pressure)
    : stages(std::move(path))
{
  state.period = expected_periods(stages, confining_pressure).front();
  state.axial_base = confining_pressure;
  state.side_base.fill(confining_pressure);
}

double LoadFollower::cycles_at(double time) const
{
  const auto after = std::ranges::upper_bound(begun, time, {}, &StageRun::time);
  if (after == begun.begin())
    return 0.;
  const StageRun &run = *(after - 1);
  const double cycles = run.cycles_before + (time - run.time) / run.period;
  return after == begun.end() ? cycles : std::min(cycles, after->cycles_before);
}

void LoadFollower::begin(const LoadMeasures &now, double cycles)
{
  state.stage = static_cast<std::int64_t>(begun.size());
  const LoadStage &s = stage();
  state.mean_axial = now.axial_stress;
  state.mean_side = 0.5 * (now.side_stress[0] + now.side_stress[1]);
  state.volume_from = now.volume;
  state.ratio_from = stress_ratio();
  // Targets that are known decide the length, and it the others.
  state.period = s.has_wave() ? s.wave.period() : s.duration;
  begin_axial(now);
  begin_side(0, now);
  begin_side(1, now);
  state.period = std::max(state.period, least_length);
  const double length = stage_length();
  state.axial_to = end_of(s.axial, state.axial_from, length);
  state.strain_to = end_of(s.axial, state.strain_from, length);
  for (std::size_t d = 0; d < 2; ++d)
    state.side_to[d] = end_of(s.sides[d], state.side_from[d], length);
  state.leading_from = leading_stress();
  begun.push_back({now.time, cycles, state.period, 0, 0});
}

void LoadFollower::begin_axial(const LoadMeasures &now)
{
  const LoadStage &s = stage();
  const bool was_driven = is_driven();
  if (s.axial.control != LoadControl::keep)
    state.is_driven = s.axial.control == LoadControl::strain ? 1 : 0;
  const bool is_other_section =
      index() > 0 && s.is_over_first_section !=
                         stages.stages[index() - 1].is_over_first_section;
  if (was_driven || is_other_section)
    state.axial_base = now.drive_stress;
  state.axial_from = state.axial_base;
  state.axial_target = is_driven() ? none : state.axial_base;
  state.strain_from = now.axial_strain;
  state.speed_from = was_driven ? now.plate_speed : 0.;
  state.period = std::max(
      state.period,
      own_length(s.axial, is_driven() ? state.strain_from : state.axial_from));
}

void LoadFollower::begin_side(std::size_t d, const LoadMeasures &now)
{
  const LoadStage &s = stage();
  const LoadDirection &side = s.sides[d];
  const bool was_moved = state.is_moved[d] != 0;
  if (s.rule != SideRule::none)
    state.is_moved[d] = s.rule == SideRule::constant_volume ? 1 : 0;
  else if (side.control != LoadControl::keep)
    state.is_moved[d] = side.control == LoadControl::strain ? 1 : 0;
  if (was_moved)
    state.side_base[d] = now.side_stress[d];
  const bool is_moved = state.is_moved[d] != 0;
  state.side_from[d] = is_moved ? now.side_strain[d] : state.side_base[d];
  state.side_target[d] = is_moved ? none : state.side_base[d];
  state.period = std::max(state.period, own_length(side, state.side_from[d]));
}

double LoadFollower::stage_length() const
{
  return state.period * stage().n_cycles();
}

/// That sides follow: of a plate that is driven what is measured.
double LoadFollower::leading_stress() const
{
  return is_driven() ? state.mean_axial : state.axial_target;
}

/// q / p [-]; 0 without any stress.
double LoadFollower::stress_ratio() const
{
  const double p = (state.mean_axial + 2. * state.mean_side) / 3.;
  return p > 0. ? (state.mean_axial - state.mean_side) / p : 0.;
}

void LoadFollower::observe(const LoadMeasures &now, double step,
                           double response_time)
{
  const double share = std::min(1., step / (mean_share * response_time));
  const double side = 0.5 * (now.side_stress[0] + now.side_stress[1]);
  state.mean_axial += share * (now.axial_stress - state.mean_axial);
  state.mean_side += share * (side - state.mean_side);
}

void LoadFollower::aim(const StagePosition &end)
{
  const LoadStage &s = stage();
  const double share = std::min(1., end.cycles / s.n_cycles());
  const double wave = s.has_wave() ? s.wave.value(end.phase) : 0.;
  if (!is_driven())
  {
    state.axial_base = std::lerp(state.axial_from, state.axial_to, share);
    state.axial_target = state.axial_base + s.amplitude * wave;
  }
  for (std::size_t d = 0; d < 2; ++d)
  {
    if (state.is_moved[d] != 0)
      continue;
    double &base = state.side_base[d];
    if (s.rule == SideRule::proportional)
      base = std::max(0., state.side_from[d] +
                              s.side_ratio *
                                  (leading_stress() - state.leading_from));
    else
      base = std::lerp(state.side_from[d], state.side_to[d], share);
    state.side_target[d] = std::max(0., base + s.side_amplitude * wave);
  }
}

void LoadFollower::aim_at(double isotropic_stress)
{
  state.axial_target = isotropic_stress;
  state.side_target.fill(isotropic_stress);
}

/// It gets up to its speed evenly; a plate that is to stand still is slowed
/// down over the same time.
double LoadFollower::plate_acceleration(const LoadMeasures &now,
                                        const StagePosition &end,
                                        double first_height) const
{
  const double period = begun.back().period, start = start_share * period;
  if (state.strain_to == state.strain_from)
    return now.plate_speed / std::max(start, least_steps * end.step);
  const double left = (start_share - end.cycles_before) * period; // [s]
  if (left <= 0.)
    return 0.;
  const double way = (state.strain_to - state.strain_from) * first_height;
  const double speed = (way - 0.5 * start * state.speed_from) /
                       (period * (1. - 0.5 * start_share));
  // A step beyond the start has the rest alone: the speed is met exactly.
  return -(speed - state.speed_from) / start * std::min(1., left / end.step);
}

double LoadFollower::side_rate(int axis, const LoadMeasures &now,
                               double response_time) const
{
  const auto d = static_cast<std::size_t>(axis);
  if (stage().rule == SideRule::constant_volume)
    return 0.5 * ((now.volume / state.volume_from - 1.) / response_time -
                  now.plate_speed / now.height);
  return (state.side_to[d] - state.side_from[d]) /
         (stage_length() * (1. - now.side_strain[d]));
}

bool LoadFollower::is_met(const LoadMeasures &now,
                          double unbalanced_ratio) const
{
  const LoadStage &s = stage();
  return (s.until_strain &&
          has_reached(state.strain_from, now.axial_strain, *s.until_strain)) ||
         (s.until_ratio &&
          has_reached(state.ratio_from, stress_ratio(), *s.until_ratio)) ||
         (s.until_unbalanced && unbalanced_ratio < *s.until_unbalanced);
}

void LoadFollower::end_interval(const LoadMeasures &now, double cycles,
                                double unbalanced_ratio)
{
  const bool is_at_end_of_cycle = cycles == std::floor(cycles);
  if (stage().has_wave() && !is_at_end_of_cycle)
    return;
  begun.back().is_met = is_met(now, unbalanced_ratio) ? 1 : 0;
  update_end(cycles);
}

void LoadFollower::update_end(double cycles)
{
  if (begun.empty())
    return;
  StageRun &run = begun.back();
  // A jump may have passed the end.
  const bool is_done =
      cycles >= stage().n_cycles() && cycles == std::floor(cycles);
  run.is_over = is_done || run.is_met != 0 ? 1 : 0;
}

void LoadFollower::save(std::ostream &out) const
{
  dem::write_value(out, state);
  dem::write_column(out, begun);
  for (std::size_t k = 0; k < begun.size(); ++k)
  {
    write_text(out, text_of(stages.stages[k]));
    dem::write_value(out, stages.stages[k].cycles);
  }
}

void LoadFollower::restore(std::istream &in)
{
  const double first_period = state.period;
  dem::read_value(in, state);
  dem::read_column(in, begun);
  if (begun.empty()) // the path may be another one
    state.period = first_period;
  for (std::size_t k = 0; k < begun.size(); ++k)
  {
    const std::string then = read_text(in);
    int cycles_then = 0;
    dem::read_value(in, cycles_then);
    const bool is_there = k < stages.stages.size();
    const bool is_finished = k + 1 < begun.size();
    if (is_there && text_of(stages.stages[k]) == then &&
        (!is_finished || stages.stages[k].cycles == cycles_then))
      continue;
    throw std::runtime_error(
        "has begun stage " + std::to_string(k + 1) +
        " of the loading path: it must be as before, was '" + then + ", " +
        std::to_string(cycles_then) + " cycles'" +
        (is_there ? ", is '" + text_of(stages.stages[k]) + ", " +
                        std::to_string(stages.stages[k].cycles) + " cycles'"
                  : ", is not there"));
  }
}
} // namespace spall
