#include <coupling/cycle_jump.h>

#include <algorithm>
#include <cmath>

namespace coupling
{
namespace
{
/// A rate falls at most like 1 / cycle: then strain grows with its logarithm.
constexpr double steepest_decay = 1.;
/// Shorter jumps do not pay: a jump costs the cycle that lands.
constexpr int shortest = 2;
/// Cycles that one stands for, at most. The right contacts wear, but particles
/// give way to that in cycles of their own: the more one stands for, the less
/// grows after it (docs/results/cycle_jump.md).
constexpr int most_in_one = 5;
/// Of its limit an error should not use more than this, in the mean.
constexpr double aim = 0.5;

double over(double error, double limit)
{
  return error == 0. ? 0. : std::abs(error) / limit;
}
} // namespace

SlowRate rate_between(const SlowState &from, const SlowState &to)
{
  const double n = to.cycle - from.cycle;
  return {0.5 * (from.cycle + to.cycle), (to.strain - from.strain) / n,
          (to.abrasion - from.abrasion) / n};
}

double PowerLaw::gain(double from, double to) const
{
  if (!(rate_a > 0. && rate_b > 0.))
  {
    const double slope = (rate_b - rate_a) / (at_b - at_a);
    return (to - from) * (rate_a + slope * (0.5 * (from + to) - at_a));
  }
  const double power = std::log(rate_b / rate_a) / std::log(at_b / at_a);
  const double scale = rate_a * at_a;
  if (std::abs(power + 1.) < 1e-6)
    return scale * std::log(to / from);
  return scale / (power + 1.) *
         (std::pow(to / at_a, power + 1.) - std::pow(from / at_a, power + 1.));
}

JumpPlan::JumpPlan(const CycleJumpParameters &p, int cycles)
    : tolerance(p.tolerance), n_cycles(cycles), n_window(p.observed),
      n_settled(p.settled), longest(p.longest), n_waiting(p.first),
      reach(p.observed)
{
}

std::int64_t JumpPlan::observed() const
{
  return phase == Phase::observe ? n_observed : -1;
}

void JumpPlan::observe_from_now()
{
  phase = Phase::observe;
  n_observed = 0;
  begun = now;
}

void JumpPlan::wait_for(std::int64_t cycles)
{
  phase = Phase::wait;
  n_waiting = cycles;
  if (n_waiting <= 0)
    observe_from_now();
}

void JumpPlan::take(const SlowState &state)
{
  if (tolerance == 0.)
    return;
  now = state;
  step = JumpStep::none;
  if (phase == Phase::damage)
  {
    if (++n_worn < n_damaging())
      step = JumpStep::damage;
    else
      phase = Phase::extrapolate;
    is_judged = 0;
  }
  else if (phase == Phase::extrapolate)
    wait_for(n_settled);
  else if (phase == Phase::wait)
    wait_for(n_waiting - 1);
  else if (++n_observed == n_window)
  {
    before = last;
    last = rate_between(begun, now);
    if (!is_judged)
      judge();
    if (step == JumpStep::none)
      plan();
  }
}

/// Compares the increments of the jump with those by the rates on both sides
/// of it.
void JumpPlan::judge()
{
  const PowerLaw strain{before.at, before.strain, last.at, last.strain},
      abrasion{before.at, before.abrasion, last.at, last.abrasion};
  const double strain_error = begun.strain - left.strain -
                              strain.gain(left.cycle, begun.cycle),
               abrasion_error = begun.abrasion - left.abrasion -
                                abrasion.gain(left.cycle, begun.cycle);
  const double used =
      std::max(over(strain_error, tolerance * std::abs(now.strain)),
               over(abrasion_error, tolerance * now.abrasion));
  is_judged = 1;
  const double worn = begun.abrasion - left.abrasion;
  if (worn > 0.)
    weight *= std::clamp((worn - abrasion_error) / worn, 1. / 3., 3.);
  if (used > 1.)
  {
    step = JumpStep::restore_state;
    return;
  }
  books.strain_error += strain_error;
  books.abrasion_error += abrasion_error;
  ++books.n_jumps;
  books.n_skipped += n_skipped;
  const double longer =
      std::clamp(std::sqrt(aim / std::max(used, 1e-9)), 0.5, 2.);
  reach = std::max<double>(shortest, n_skipped * longer);
}

/// The cycles after a jump are simulated before the loading ends, so that every
/// jump is judged.
void JumpPlan::plan()
{
  const int to_end = n_cycles - static_cast<int>(std::lround(now.cycle)) - 1 -
                     n_settled - n_window;
  n_skipped = std::min({static_cast<int>(reach), longest, to_end});
  while (n_skipped >= shortest && n_skipped + n_damaging() > to_end)
    --n_skipped;
  if (n_skipped >= shortest && before.at > 0.)
    step = JumpStep::save_state;
  else
    observe_from_now();
}

void JumpPlan::begin()
{
  if (step == JumpStep::save_state)
  {
    left = now;
    phase = Phase::damage;
    n_worn = 0;
  }
  step = JumpStep::none;
}

int JumpPlan::n_damaging() const
{
  return (n_skipped + most_in_one - 2) / (most_in_one - 1);
}

int JumpPlan::skipping() const
{
  if (phase != Phase::damage)
    return 0;
  const auto until = [this](std::int64_t cycle)
  { return static_cast<int>(n_skipped * cycle / n_damaging()); };
  return until(n_worn + 1) - until(n_worn);
}

double JumpPlan::repetitions() const
{
  if (phase != Phase::damage)
    return 1.;
  // Deficits and excesses of earlier jumps are compensated.
  const double n = 1. + skipping() * weight;
  const double owed = last.abrasion > 0. ? -books.abrasion_error /
                                               (last.abrasion * n_damaging())
                                         : 0.;
  return n + std::clamp(owed, -0.5 * n, 0.5 * n);
}

double JumpPlan::expected_strain() const
{
  PowerLaw law{before.at, before.strain, last.at, last.strain};
  // Two short observations are uncertain: not a rate that grows, nor one that
  // falls faster than that.
  law.rate_a =
      std::clamp(law.rate_a, law.rate_b,
                 law.rate_b * std::pow(law.at_b / law.at_a, steepest_decay));
  return law.gain(left.cycle, left.cycle + n_skipped + n_damaging());
}

double JumpPlan::missing_strain() const
{
  if (last.strain <= 0.)
    return 0.;
  const double strain =
      expected_strain() - books.strain_error - (now.strain - left.strain);
  return std::clamp(strain, 0., 1.5 * (n_skipped + n_damaging()) * last.strain);
}

void JumpPlan::shorten(const JumpPlan &refused)
{
  books.n_refused = refused.books.n_refused + 1;
  weight = refused.weight;
  n_skipped = refused.n_skipped / 2;
  step = n_skipped >= shortest ? JumpStep::save_state : JumpStep::none;
  reach = n_skipped;
  if (step == JumpStep::save_state)
    return;
  // Too early: some more cycles, then as at first.
  reach = n_window;
  observe_from_now();
}

int least_cycles(const CycleJumpParameters &parameters, int n_cycles)
{
  JumpPlan plan(parameters, n_cycles);
  int n_simulated = 0;
  for (double cycle = 0.; cycle < n_cycles; ++n_simulated)
  {
    plan.begin();
    cycle += plan.skipping() + 1;
    plan.take({cycle, cycle, cycle}); // what grows evenly has no error
  }
  return n_simulated;
}
} // namespace coupling
