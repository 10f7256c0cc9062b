#pragma once

#include "case/case.h"
#include "run/energy_balance.h"
#include "run/frames.h"
#include "run/step_watch.h"
#include "specimen/specimen.h"

#include <nlohmann/json_fwd.hpp>

#include <functional>
#include <iosfwd>
#include <memory>
#include <string>
#include <vector>

namespace spall
{
/// What is due after a step.
struct Due
{
  bool row = false, frame = false, checkpoint = false;
};

/// One column of history.csv with its value in this row.
struct Quantity
{
  const char *name; ///< name_unit
  double value = 0.;
};

/// A file that a test writes besides those of every run.
struct NamedText
{
  std::string name, text;
};

/// A test that is run step by step: what all kinds but the triaxial test have
/// in common.
class LabTest
{
public:
  virtual ~LabTest() = default;
  LabTest(const LabTest &) = delete;
  LabTest &operator=(const LabTest &) = delete;

  /// One step. Throws coupling::GuardStop after one that a guard stops at.
  void advance();
  /// Share of the whole test that is done; 1: it is over [-].
  virtual double share_done() const = 0;
  /// Of the whole test [s].
  virtual double duration() const = 0;
  /// In which its load or motion comes back; 0: none [s].
  virtual double period() const { return 0.; }
  /// Between frames; 0: not known, they come with its motion [s].
  virtual double frame_interval() const { return 0.; }
  /// Where it is, in a few words.
  virtual std::string phase() const = 0;
  virtual Due due() const = 0;

  /// How far the test was at a time, in the unit of its column of events.csv.
  virtual double progress_at(double time) const = 0;
  virtual const char *progress_column() const = 0;

  /// Whether bodies are joined to the particles at some time of the test, and
  /// their exchange once they are.
  virtual bool has_ledger() const { return false; }
  virtual const coupling::Exchange *exchange() const { return nullptr; }
  /// Of a test with an exchange; else null.
  virtual const SetupStep *setup_step() const { return nullptr; }
  virtual FrameParts frame_parts() const { return {nullptr, true}; }
  /// Since the last call.
  virtual std::vector<NamedText> take_files() { return {}; }
  /// All particles that the test will have; only what does not move counts.
  virtual const dem::ParticleSystem &all_particles() const
  {
    return engine().particles();
  }
  /// Prints what `spall check` says besides particles, step, memory and time.
  virtual void describe() const {}
  /// Until the particles are prepared, about, in steps that cost what those of
  /// the test do; 0: they need no preparation [s].
  virtual double preparation_time() const { return 0.; }
  /// On to what a step costs for most of duration(), from the beginning or from
  /// where the particles are prepared, and by shortcuts: what is measured from
  /// then on is worth nothing. Returns the step of the preparation once
  /// particles press on each other; 0: there is none to come [s]. Throws as
  /// advance() does.
  virtual double fast_preparation() { return 0.; }

  /// What the test has come to: three to six numbers with their units.
  virtual std::string outcome() const = 0;
  /// What a reader of the results must know, a line each.
  virtual std::vector<std::string> warnings() const;
  /// The row of history.csv now: what the test measures, then counts and
  /// energies.
  std::vector<Quantity> row() const;
  /// Energies since the start of the test.
  EnergyBalance energy_balance() const;
  /// What summary.json and the end of the log show; of the whole test unless a
  /// kind has a loading of its own.
  virtual EnergyBalance reported_balance() const { return energy_balance(); }
  /// Adds what summary.json says of this test.
  virtual void summarise(nlohmann::ordered_json &summary) const;
  /// Ends after so many turns, whatever the case says. Throws InputError for a
  /// test that has none.
  virtual void stop_after(int turns);
  /// Whether it was told to end before the case does.
  virtual bool ends_early() const { return false; }

  /// What decides how the particles are prepared, a line each; empty: there is
  /// nothing that tests could share.
  virtual std::string preparation_text() const { return {}; }
  virtual bool is_preparing() const { return false; }
  /// Called when the particles are prepared.
  void when_prepared(std::function<void()> call)
  {
    call_prepared = std::move(call);
  }
  /// The particles then, and back from there into any test of the same
  /// preparation_text(), which goes on as if it had prepared them itself. The
  /// latter throws std::runtime_error.
  virtual void save_prepared(std::ostream &out) const { save(out); }
  virtual void take_prepared(std::istream &in) { restore(in); }

  virtual void save(std::ostream &out) const; ///< full state, bit for bit
  /// Continues a saved test of the same case; throws std::runtime_error.
  virtual void restore(std::istream &in);

  /// Breakage events since the last call.
  std::vector<dem::BreakageEvent> take_events();
  const dem::Engine &engine() const { return *owned_engine; }
  dem::Engine &engine() { return *owned_engine; }
  virtual int steps_in_move() const { return 1; } ///< of the particles
  double time_step() const { return step; }       ///< last or next one [s]
  const dem::StepLimit &step_limit() const { return limit; } ///< at setup
  /// Lines for the log since the last call.
  std::vector<std::string> take_notes() { return watch.take_notes(); }
  double watch_seconds() const { return watch.seconds(); }
  /// Abrasion of the particles, those of other materials left out [%].
  double abrasion_percent() const;

protected:
  /// Takes the scene; the engine has all its particles.
  LabTest(const Case &parameters, ShapeLibrary shapes,
          std::unique_ptr<dem::Engine> scene);
  /// Of a scene that does not have all its particles yet: the longest step of
  /// any of them, and the first one [s].
  LabTest(const Case &parameters, ShapeLibrary shapes,
          std::unique_ptr<dem::Engine> scene, const dem::StepLimit &limit,
          double first_step);

  /// Particles and bodies take a window; a guard stops the test when move() is
  /// over.
  void exchange_window(coupling::Exchange &joined, double window);
  /// From now on another rule for the steps, and `cap` as StepWatch has it.
  void change_steps(const TimeParameters &rule, double cap);
  /// The first steps of a test, likewise.
  void begin_steps(const TimeParameters &rule, double cap);
  /// Steps as the contacts allow them now: at once, where a scene has changed.
  void check_contacts();
  /// Where loading begins: throws RunFailure as StepWatch::report.
  void report_step()
  {
    engine().synchronize();
    watch.report(engine(), surroundings(), step);
  }
  void say_prepared() const;
  /// A line for the one who runs it, after this step.
  void say(const std::string &line) { watch.say(line); }
  /// The boundaries take their speed and the engine a step, or
  /// steps_in_move() of them.
  virtual void move(double time_step) = 0;
  virtual std::vector<Quantity> measured() const = 0;
  /// Done by gravity and by what is outside on the particles and bodies [J].
  virtual double external_work() const;
  /// Of the bodies that are joined to the particles.
  virtual coupling::BodyEnergy body_energy() const { return {}; }
  virtual Surroundings surroundings() const { return {}; }
  virtual std::vector<dem::BreakageEvent> fresh_events()
  {
    return engine().take_events();
  }

  Case parameters;
  ShapeLibrary shapes;

private:
  std::unique_ptr<dem::Engine> owned_engine;
  dem::StepLimit limit;
  StepWatch watch;
  std::function<void()> call_prepared;
  std::string stopped_by; ///< words of a guard; empty: none
  double step = 0.;       ///< [s]
  double first_event_time = -1., first_event_force = 0.; ///< [s], [N]
};

/// The fixed step, or the longest for the lightest particle on one wall. Throws
/// InputError if the fixed one is longer.
double first_step(const Case &parameters, const dem::StepLimit &limit);

/// The scene of any case but a dynamic_triaxial one. Throws InputError.
std::unique_ptr<LabTest> make_lab_test(const Case &parameters);
} // namespace spall
