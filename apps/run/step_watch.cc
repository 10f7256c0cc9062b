#include "run/step_watch.h"

#include "errors.h"

#include <dem/measure/contact_springs.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <limits>
#include <utility>

namespace spall
{
namespace
{
/// Steps between two checks, windows where a window has several.
constexpr std::int64_t check_interval = 200, fixed_interval = 1000;
/// Checks between two evaluations of the frequency of the membrane.
constexpr std::int64_t membrane_interval = 15;
/// The frequency of the membrane may have grown by this since [-].
constexpr double membrane_headroom = 1.02;
constexpr double growth = 1.1; // of the step from check to check [-]
/// A step that has changed by this factor is worth a line [-].
constexpr double noticeable = 1.25;

std::string line(const char *format, double a, double b, double c,
                 const std::string &reason)
{
  char text[160];
  std::snprintf(text, sizeof text, format, a, b, c);
  return text + reason;
}

std::string describe(const dem::ForeseenImpact &impact)
{
  char text[100];
  std::snprintf(text, sizeof text, "an impact at %.3g m/s that lasts %.3g s",
                impact.speed, impact.duration);
  return text;
}
} // namespace

StepWatch::StepWatch(const TimeParameters &time, double cap_of_step)
    : parameters(time), cap(cap_of_step)
{
  record.longest = time.safety * cap;
}

void StepWatch::follow(const TimeParameters &rule)
{
  record.longest *= std::min(1., rule.safety / parameters.safety);
  parameters = rule;
}

void StepWatch::set_cap(double cap_of_step)
{
  cap = cap_of_step;
  record.longest = std::min(record.longest, parameters.safety * cap);
}

bool StepWatch::is_due(std::int64_t n_steps) const
{
  return n_steps % (is_fixed() ? fixed_interval : check_interval) == 0;
}

dem::SpringNetwork StepWatch::springs(const dem::Engine &engine,
                                      const Surroundings &around,
                                      double horizon)
{
  dem::SpringNetwork network = around.has_membrane()
                                   ? around.exchange->springs(engine, horizon)
                                   : dem::contact_springs(engine, horizon);
  dem::share_springs(engine, network);
  if (!around.has_membrane() ||
      around.exchange->rule() != coupling::ExchangeRule::every_step)
    return network;
  if (record.membrane_step == 0. || record.n_checks % membrane_interval == 0)
    record.membrane_step = around.membrane->stable_time_step();
  network.point_frequency = membrane_headroom * 2. / record.membrane_step;
  return network;
}

void StepWatch::update(const dem::Engine &engine, const Surroundings &around,
                       double present_step)
{
  const auto start = std::chrono::steady_clock::now();
  // What the particles may reach before the next check.
  const double horizon = is_fixed() ? 0.
                                    : static_cast<double>(check_interval) *
                                          around.particle_steps * present_step;
  const dem::SpringNetwork network = springs(engine, around, horizon);
  ++record.n_checks;
  dem::NetworkStep bound = dem::guaranteed_step(network);
  bound.step = std::min(bound.step, gain_step(engine, around, present_step));
  if (is_fixed())
    judge_fixed(network, bound, present_step);
  else
    allow(network, bound, engine.time());
  spent +=
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start)
          .count();
}

double StepWatch::gain_step(const dem::Engine &engine,
                            const Surroundings &around, double step)
{
  if (!around.has_membrane() ||
      around.exchange->rule() != coupling::ExchangeRule::one_pass ||
      around.exchange->has_contact_tangent())
    return std::numeric_limits<double>::infinity();
  const double gain =
      around.exchange->gain(engine, around.particle_steps * step);
  const double limit = around.gain.one_pass_limit;
  if (gain > 1.)
    throw RunFailure(line("exchange gain %.3g at %.5f s, above 1 with "
                          "Coupling/exchange = one_pass (limit %.3g)",
                          gain, engine.time(), limit,
                          ": use iterated, or shorter windows"));
  if (gain > limit && gain > 1.1 * record.worst_gain)
    say(line("warning: exchange gain %.3g at %.5f s, one pass is stable below "
             "%.3g",
             gain, engine.time(), limit, ""));
  record.worst_gain = std::max(record.worst_gain, gain);
  return gain > 0. ? step * std::sqrt(limit / gain)
                   : std::numeric_limits<double>::infinity();
}

void StepWatch::report(const dem::Engine &engine, const Surroundings &around,
                       double present_step)
{
  const dem::SpringNetwork network = springs(engine, around, 0.);
  const dem::NetworkStep bound = dem::guaranteed_step(network);
  if (dem::total_contacts(network) > 0)
    say(line("%.0f contacts: stable up to %.3g s for sure, unstable above %.3g "
             "s: ",
             static_cast<double>(dem::total_contacts(network)), bound.step,
             dem::sharp_step(network),
             dem::describe_body(network, bound.body)));
  if (is_fixed())
    require_stable(network, bound, present_step);
}

/// Where loading begins: from then on a longer step falsifies what is measured.
void StepWatch::require_stable(const dem::SpringNetwork &network,
                               const dem::NetworkStep &bound, double step)
{
  judge_fixed(network, bound, step);
  if (step <= record.limit || parameters.allow_unstable_step)
    return;
  throw RunFailure(
      line("Time/fixed_step = %.3g s is above the %.3g s from which the "
           "contacts are unstable (at most %.3g s is stable for sure): ",
           step, record.limit, bound.step,
           dem::describe_body(network, bound.body) +
               ": use a shorter one or Time/step = stable; "
               "Time/allow_unstable_step = true runs it nevertheless"));
}

void StepWatch::judge_fixed(const dem::SpringNetwork &network,
                            const dem::NetworkStep &bound, double step)
{
  record.limit = bound.step;
  if (step <= bound.step)
  {
    record.worst_share = std::max(record.worst_share, step / bound.step);
    return;
  }
  record.limit = dem::sharp_step(network);
  const double share = step / record.limit, before = record.worst_share;
  record.worst_share = std::max(before, share);
  if (share > 1. && share > 1.1 * before)
    say(line("warning: Time/fixed_step = %.3g s is %.3g times the %.3g s that "
             "the contacts allow: ",
             step, share, record.limit,
             dem::describe_body(network, bound.body) + ": use Time/step"
                                                       " = stable"));
}

void StepWatch::allow(const dem::SpringNetwork &network,
                      const dem::NetworkStep &bound, double time)
{
  record.limit = std::min(cap, bound.step);
  const double safe = parameters.safety * record.limit;
  // The energy error of an impact is a bound by itself.
  const double resolving =
      network.impact.duration / dem::steps_of_impact(parameters.impact_error);
  record.longest = std::min({safe, resolving, growth * record.longest});
  const double change = record.longest / std::max(record.said, 1e-300);
  if (change < noticeable && change > 1. / noticeable)
    return;
  record.said = record.longest;
  say(line("%.5f s: steps of up to %.3g s, limit %.3g s: ", time,
           record.longest, std::min(record.limit, resolving),
           resolving < safe ? describe(network.impact)
           : bound.step < cap
               ? dem::describe_body(network, bound.body)
               : "any particle by itself, or one membrane node"));
}

void StepWatch::note_used(double step)
{
  if (record.shortest_used == 0.)
    record.shortest_used = step;
  record.shortest_used = std::min(record.shortest_used, step);
  record.longest_used = std::max(record.longest_used, step);
}

std::vector<std::string> StepWatch::take_notes()
{
  return std::exchange(notes, {});
}
} // namespace spall
