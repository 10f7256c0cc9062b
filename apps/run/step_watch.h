#pragma once

#include "case/case.h"

#include <coupling/exchange.h>
#include <coupling/gain.h>

#include <string>
#include <vector>

namespace spall
{
/// Results of the checks; plain data for the checkpoint.
struct StepRecord
{
  std::int64_t n_checks = 0;
  double limit = 0.;         ///< allowed by contacts and walls, last check [s]
  double longest = 0.;       ///< step that may be taken, safety applied [s]
  double membrane_step = 0.; ///< of the membrane alone, last check; 0: none [s]
  double said = 0.;          ///< step of the last line in the log [s]
  double worst_share = 0.;   ///< largest fixed step over limit [-]
  double worst_gain = 0.;    ///< of the windows of one pass [-]
  double shortest_used = 0., longest_used = 0.; ///< while loading [s]
};

/// What moves around the particles.
struct Surroundings
{
  const coupling::Exchange *exchange = nullptr;       ///< null: planes only
  const coupling::DeformableBody *membrane = nullptr; ///< the body that has it
  coupling::WindowGain gain; ///< at setup, for the limit of one pass
  int particle_steps = 1;    ///< of a window

  bool has_membrane() const { return membrane != nullptr; }
};

/// Checks the present contacts and reports the longest stable step.
class StepWatch
{
public:
  /// `cap`: longest step for any single particle that meets a wall, and for one
  /// contact on a membrane node [s].
  StepWatch(const TimeParameters &parameters, double cap);

  /// Whether a check is due after so many steps, or windows of several.
  bool is_due(std::int64_t n_steps) const;
  /// Checks. With the rules stable and error, `longest` is then at most safety
  /// times the limit, and grows by no more than a tenth at a time. With
  /// the rule fixed a step above the limit is reported in the log.
  void update(const dem::Engine &engine, const Surroundings &around,
              double present_step);
  /// Reports what the present contacts allow: bound, sharp limit, which
  /// particle. Throws RunFailure where a fixed step is above the sharp limit,
  /// unless Time/allow_unstable_step is set.
  void report(const dem::Engine &engine, const Surroundings &around,
              double present_step);
  /// The membrane has come or gone: its frequency is evaluated again.
  void forget_membrane() { record.membrane_step = 0.; }
  /// From now on another rule; a longer step is reached check by check.
  void follow(const TimeParameters &rule);
  /// From now on another cap, as in the constructor [s].
  void set_cap(double cap_of_step);

  bool is_fixed() const { return parameters.step == StepRule::fixed; }
  void note_used(double step);
  /// A line for the log.
  void say(const std::string &line) { notes.push_back(line); }
  /// Lines since the last call.
  std::vector<std::string> take_notes();

  double seconds() const { return spent; } ///< wall-clock [s]
  const StepRecord &state() const { return record; }
  void set_state(const StepRecord &state) { record = state; }

private:
  /// Springs of the contacts, and of the membrane at its last evaluation.
  dem::SpringNetwork springs(const dem::Engine &engine,
                             const Surroundings &around, double horizon);
  /// Step that the gain of one pass allows [s]; throws RunFailure above 1.
  double gain_step(const dem::Engine &engine, const Surroundings &around,
                   double step);
  void judge_fixed(const dem::SpringNetwork &network,
                   const dem::NetworkStep &bound, double step);
  void require_stable(const dem::SpringNetwork &network,
                      const dem::NetworkStep &bound, double step);
  void allow(const dem::SpringNetwork &network, const dem::NetworkStep &bound,
             double time);

  TimeParameters parameters;
  double cap;
  StepRecord record;
  std::vector<std::string> notes;
  double spent = 0.;
};
} // namespace spall
