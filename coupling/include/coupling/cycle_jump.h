#pragma once

#include <cstdint>

namespace coupling
{
/// Jumps over load cycles.
struct CycleJumpParameters
{
  double tolerance = 0.; ///< of a jump; 0: every cycle is simulated [-]
  int first = 5;         ///< cycles before the first observation
  int observed = 4;      ///< cycles in an observation
  int settled = 7;       ///< cycles after a landing before the next one
  int longest = 50;      ///< cycles that a jump skips at most

  bool is_on() const { return tolerance > 0.; }
};

/// What grows slowly from load cycle to load cycle.
struct SlowState
{
  double cycle = 0.;    ///< whose end it is [-]
  double strain = 0.;   ///< permanent, axial [-]
  double abrasion = 0.; ///< LAA [%]
};

/// Growth per cycle, and the cycle that it is of.
struct SlowRate
{
  double at = 0., strain = 0., abrasion = 0.;
};

/// Mean between the ends of two cycles, of the middle between them.
SlowRate rate_between(const SlowState &from, const SlowState &to);

/// A rate that follows a power of the cycle number through two points, as in
/// shakedown and ratcheting; where one of them is not positive, a straight
/// line.
struct PowerLaw
{
  double at_a = 1., rate_a = 0.;
  double at_b = 2., rate_b = 0.;

  /// Integral over the cycles from `from` to `to`.
  double gain(double from, double to) const;
};

/// The next thing that a run has to do at the end of a cycle.
enum class JumpStep : std::int64_t
{
  none,
  save_state,   ///< the state: a jump begins
  damage,       ///< the next cycle of the jump that stands for many
  restore_state ///< to the state kept: the last jump was too far
};

/// What jumps have done.
struct JumpAccount
{
  std::int64_t n_jumps = 0, n_refused = 0;
  std::int64_t n_skipped = 0; ///< cycles
  /// Sums of their increments less the expected ones: strain [-], LAA [%].
  double strain_error = 0., abrasion_error = 0.;
};

/// When to jump over how many load cycles, and whether that was too far. A jump
/// is some cycles each of which wears the particles as many times as it skips
/// others, one that adds the strain that is missing then, some in which what
/// has broken bears its load again, and some to observe. The rates
/// before and after it, with a power law between them, give its expected
/// increments (docs/theory/cycle_jump.md). Plain data for the checkpoint.
class JumpPlan
{
public:
  /// Of a loading of so many cycles.
  JumpPlan(const CycleJumpParameters &parameters, int n_cycles);

  /// Takes in the end of a simulated cycle.
  void take(const SlowState &state);
  JumpStep due() const { return step; }
  /// Cycles that the jump which is due skips.
  int length() const { return n_skipped; }

  /// The jump that is due begins or continues with the next cycle.
  void begin();
  int skipping() const; ///< cycles skipped before the coming one
  /// How often the coming cycle wears the particles.
  double repetitions() const;
  /// The next cycle, the one after the damage cycles, adds the missing
  /// strain.
  bool is_landing() const { return phase == Phase::extrapolate; }
  double missing_strain() const;                     ///< [-]
  double strain_rate() const { return last.strain; } ///< observed, a cycle [-]

  /// Cycles that the motion has been observed over; 0: from here on.
  std::int64_t observed() const;
  /// Where `refused` began its jump: half its length, or none.
  void shorten(const JumpPlan &refused);
  /// The whole loading has so many cycles.
  void set_end(int cycles) { n_cycles = cycles; }
  const JumpAccount &account() const { return books; }

private:
  enum class Phase : std::int64_t
  {
    wait,       ///< the first cycles, and those after an extrapolation
    observe,    ///< cycles whose growth counts
    damage,     ///< cycles that stand for those that are skipped
    extrapolate ///< one that adds the missing strain
  };

  void observe_from_now();
  void wait_for(std::int64_t cycles); ///< and observe then
  void judge();
  void plan();
  int n_damaging() const; ///< cycles that stand for the others
  /// Expected strain of the skipped cycles and the damage cycles [-].
  double expected_strain() const;

  double tolerance = 0.;
  int n_cycles = 0, n_window = 1, n_settled = 0, longest = 1, n_skipped = 0;
  Phase phase = Phase::wait;
  JumpStep step = JumpStep::none;
  std::int64_t n_waiting = 0, n_observed = 0, n_worn = 0;
  std::int64_t is_judged = 1; ///< there was no jump since
  double reach = 0.;          ///< length that errors allow [cycles]
  double weight =
      1.; ///< of a skipped cycle in the damage cycles, as judged so far [-]
  SlowState now, begun, left; ///< last; of the observation; of the last jump
  SlowRate before, last;      ///< of the last two observations
  JumpAccount books;
};

/// Cycles that are simulated of so many if no jump is off: the fewest.
int least_cycles(const CycleJumpParameters &parameters, int n_cycles);
} // namespace coupling
