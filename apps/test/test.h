#pragma once

#include "case/case.h"
#include "run/energy_balance.h"
#include "run/forecast.h"
#include "run/frames.h"
#include "run/step_watch.h"
#include "specimen/specimen.h"
#include "test/boundary_columns.h"
#include "test/removed_mass.h"
#include "test/slice_space.h"

#include <dem/measure/totals.h>
#include <dem/parallel/first_rank.h>

#include <nlohmann/json_fwd.hpp>

#include <array>
#include <cstdint>
#include <functional>
#include <iosfwd>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

namespace dem
{
class Pouring;
}

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
  std::string name; ///< name_unit
  double value = 0.;
  bool is_live = false; ///< shown on the progress line
};

/// A table that a test writes besides history.csv, events.csv and ledger.csv,
/// and a row of it.
struct TableHeader
{
  std::string file, header; ///< header: name_unit, separated by commas
};
struct TableRow
{
  std::string file;
  std::vector<double> values;
};

/// Result of a preparation by shortcuts.
struct FastPreparation
{
  /// Step of the particles once they press on each other; 0: no preparation was
  /// left [s].
  double step = 0.;
  /// Cost of such steps, if it was measured on the way.
  std::optional<MeanStep> cost = {};
  bool is_packed = true; ///< false: still loose, and steps will cost more
};

/// Requests of a test to its recorder after a step.
enum class Rewind
{
  none,
  save_state,   ///< save test and files as they are now
  restore_state ///< restore what was saved, by Test::go_back()
};

/// A file that a test writes besides those of every run.
struct NamedText
{
  std::string name, text;
};

/// A test that is run step by step: what all kinds have in common. Run loop,
/// recorder and `spall check` depend on this alone. A kind derives from it
/// (docs/developer/extending.md).
class Test
{
public:
  virtual ~Test() = default;
  Test(const Test &) = delete;
  Test &operator=(const Test &) = delete;

  // Progress.

  /// Takes one step. The last half kick of the particles may stay pending
  /// (dem::Engine::synchronize). Throws coupling::GuardStop after a step that a
  /// guard stops at, and RunFailure where the test cannot continue.
  virtual void advance();
  /// Share of the whole test that is done; at 1 the test is over [-].
  virtual double share_done() const = 0;
  /// Length of the whole test without its preparation [s].
  virtual double duration() const = 0;
  /// Period of its load or motion; 0: it has none [s].
  virtual double period() const { return 0.; }
  /// Name of the present phase, for the progress line.
  virtual std::string phase() const = 0;
  /// Numbers for the progress line: by default the live quantities of row().
  virtual std::string live_numbers();
  /// Progress of the test at a time, in the unit of its column of events.csv.
  virtual double progress_at(double time) const = 0;
  /// Name of that column, name_unit.
  virtual const char *progress_column() const = 0;
  /// Ends the test after so many turns or cycles, instead of the end of the
  /// case. Throws InputError for a test that has none.
  virtual void stop_after(int turns);
  /// Whether stop_after() ends the test before the case does.
  virtual bool ends_early() const { return false; }
  /// Lines for the log since the last call.
  std::vector<std::string> take_notes() { return watch.take_notes(); }

  // What is written.

  /// What is to be written before the first step.
  virtual Due due_at_start() const
  {
    return {true, dem::total_particles(synchronized()) > 0, false};
  }
  /// What is to be written after the last step.
  virtual Due due() const = 0;
  /// The row of history.csv now: time, measured(), counts and energies.
  virtual std::vector<Quantity> row() const;
  /// The same for history.csv: a test may store it as its last row.
  virtual std::vector<Quantity> take_row() { return row(); }
  /// Breakage events since the last call.
  std::vector<dem::BreakageEvent> take_events();
  /// Planes, drum and coupled surfaces that have columns in history.csv, the
  /// same from the first row on.
  virtual std::vector<NamedBoundary> named_boundaries() const { return {}; }
  /// Headers of the tables besides history, events and ledger.
  virtual std::vector<TableHeader> tables() const { return {}; }
  /// Rows of tables() since the last call, in order.
  virtual std::vector<TableRow> take_table_rows() { return {}; }
  /// Files to be written since the last call.
  virtual std::vector<NamedText> take_files() { return {}; }
  /// Whether the test has a ledger.csv: bodies are coupled to the particles at
  /// some time of it.
  virtual bool has_ledger() const { return false; }
  /// Columns of ledger.csv besides those of every ledger.
  virtual std::vector<Quantity> own_ledger() const { return {}; }
  /// What a frame shows besides equivalent spheres and contacts.
  virtual FrameParts frame_parts() const { return {nullptr, true}; }
  /// Time between frames; 0: frames come with its motion [s].
  virtual double frame_interval() const { return 0.; }
  /// Results so far: three to six numbers with their units.
  virtual std::string outcome() const = 0;
  /// Warnings on the results, a line each.
  virtual std::vector<std::string> warnings() const;
  /// Adds the entries of this test to summary.json.
  virtual void summarise(nlohmann::ordered_json &summary) const;
  /// Energies since the start of the test.
  virtual EnergyBalance energy_balance() const;
  /// The balance in summary.json and at the end of the log: that of the whole
  /// test unless a kind has a loading of its own.
  virtual EnergyBalance reported_balance() const { return energy_balance(); }
  /// Adds wall-clock of phases that the engine and the exchange do not measure
  /// [s].
  virtual void add_clocks(std::map<std::string, double> &seconds) const;
  /// Mass of the particles now and at first, those of other materials left out
  /// [kg]. Collective.
  std::array<double, 2> particle_masses() const;
  /// Mass that the particles have lost over their initial mass, those of other
  /// materials left out [%]. Collective.
  double abrasion_percent() const;

  // Scene.

  /// On many ranks its particles are those of this rank, and sums over all
  /// ranks are collective: dem/measure/totals.h. gather_scene() copies those of
  /// all.
  const dem::Engine &engine() const { return *owned_engine; }
  dem::Engine &engine()
  {
    copy.reset();
    return *owned_engine;
  }
  /// The engine with no half kick pending: for sums over what each rank has.
  const dem::Engine &synchronized() const;
  /// Copies the scene of all ranks to the first one, for what needs all
  /// particles at once: dem::Engine::gathered(). Nothing is done where nothing
  /// has changed since, and where whole() is the engine itself, see
  /// is_gathered(). Finishes a half kick that is pending. Collective.
  void gather_scene() const;
  /// The scene of all ranks as gather_scene() has copied it, which one rank
  /// alone need not call before. Throws std::logic_error on other ranks than
  /// the first, and where the scene has changed since.
  const dem::Engine &whole() const;
  /// Calls `use` with whole() on the first rank. What it throws there all ranks
  /// throw, see on_first_rank(). Collective.
  void with_whole(const std::function<void(const dem::Engine &)> &use) const;
  /// What `measure` returns for whole() on the first rank: a text, entries or
  /// plain data, see dem::of_first_rank(). Collective.
  template <class Measure>
  auto of_whole(const Measure &measure) const
  {
    std::invoke_result_t<Measure, const dem::Engine &> value{};
    with_whole([&](const dem::Engine &scene) { value = measure(scene); });
    return dem::of_first_rank(ranks(), value);
  }
  /// Copies that gather_scene() has made so far.
  int n_scene_copies() const { return n_copies; }
  /// All ranks that the test runs on.
  const dem::Ranks &ranks() const;
  /// Calls `use` on the first rank with all particles that the test will have;
  /// only ids, sizes and shapes count. Collective.
  void with_all_particles(
      const std::function<void(const dem::ParticleSystem &)> &use) const;
  /// Their number. Collective.
  std::int64_t n_particles() const;
  /// Whether the particles are cut into slices where their loading begins and
  /// where the run ends.
  virtual bool has_slices() const { return false; }
  /// Of a test with slices: none before the loading begins. Collective.
  virtual std::optional<SliceSpace> slice_space() const { return {}; }
  /// Shapes of the particles that have not broken.
  const ShapeLibrary &shape_library() const { return shapes; }
  /// Exchange of particles and bodies; null while there is none.
  virtual const coupling::Exchange *exchange() const { return nullptr; }
  /// The step chosen at setup, of a test with an exchange; else null.
  virtual const SetupStep *setup_step() const { return nullptr; }
  /// Limit of the step at setup and its reason.
  const dem::StepLimit &step_limit() const { return limit; }
  /// Length of the last or next step of the particles [s].
  virtual double time_step() const { return step; }
  /// Steps of the particles in one advance().
  virtual int steps_in_move() const { return 1; }
  /// Length of a window of the exchange [s].
  virtual double window() const { return steps_in_move() * time_step(); }

  // Preparation, and its forecast by `spall check`.

  /// What decides the prepared particles, a line each; empty: tests of this
  /// kind share no preparation.
  virtual std::string preparation_text() const { return {}; }
  /// Whether the particles are still being prepared.
  virtual bool is_preparing() const { return false; }
  /// `call` is called once, when the particles are prepared.
  void when_prepared(std::function<void()> call)
  {
    call_prepared = std::move(call);
  }
  /// Saves the prepared particles at that moment, as save(). Collective.
  virtual void save_prepared(std::ostream &out) const
  {
    save(out, dem::StateExtent::scene);
  }
  /// Restores them into any test of the same preparation_text(), which
  /// continues as if it had prepared them itself. Throws std::runtime_error.
  virtual void take_prepared(std::istream &in) { restore(in); }
  /// Expected length of the preparation, in steps that cost what those of the
  /// test do; 0: the particles need none [s].
  virtual double preparation_time() const { return 0.; }
  /// Continues to where a step costs what it does for most of duration(), by
  /// shortcuts: what is measured from then on is worth nothing. Throws as
  /// advance() does.
  virtual FastPreparation fast_preparation() { return {}; }
  /// Prints the lines of `spall check` that this kind has besides particles,
  /// step, memory and time.
  virtual void describe() const {}
  /// The same about the time, where steps cost this much on average.
  virtual void describe_time(const MeanStep &) const {}

  // State.

  /// Saves the full state, bit for bit: of all ranks on the first one, to a
  /// file, or what each of them has, to come back to it. Collective.
  virtual void save(std::ostream &out, dem::StateExtent extent) const;
  /// Restores a saved test of the same case. Throws std::runtime_error.
  /// Collective.
  virtual void restore(std::istream &in);
  /// What the recorder is to do with the state after the last step.
  virtual Rewind rewind() const { return Rewind::none; }
  /// Calls `restore_saved`, which restores the state saved before.
  virtual void go_back(const std::function<void()> &restore_saved)
  {
    restore_saved();
  }

protected:
  /// Adds the particles to the engine; null: it has had them from the start.
  virtual const dem::Pouring *poured_by() const { return nullptr; }
  /// Takes the scene; the engine has all its particles.
  Test(const Case &parameters, ShapeLibrary shapes,
       std::unique_ptr<dem::Engine> scene);
  /// The same with a first step that the test has chosen itself [s].
  Test(const Case &parameters, ShapeLibrary shapes,
       std::unique_ptr<dem::Engine> scene, double first_step);
  /// Takes a scene that does not have all its particles yet, with the longest
  /// step of any of them and the first step [s].
  Test(const Case &parameters, ShapeLibrary shapes,
       std::unique_ptr<dem::Engine> scene, const dem::StepLimit &limit,
       double first_step);

  /// Whether gather_scene() makes a copy in the order of the ids: where the
  /// case can be spread over ranks.
  virtual bool is_gathered() const { return is_shareable; }
  /// Advances particles and bodies by a window [s]. Where a guard stops it,
  /// advance() throws after move().
  void exchange_window(coupling::Exchange &joined, double window);
  /// Changes the rule of the steps, and the cap of StepWatch [s].
  void change_steps(const TimeParameters &rule, double cap);
  /// Sets them for the first steps of a test.
  void begin_steps(const TimeParameters &rule, double cap);
  /// Sets the step to what the contacts allow now, where a scene has changed.
  void check_contacts();
  /// Reports the step where loading begins. Throws as StepWatch::report.
  void report_step() { watch.report(synchronized(), surroundings(), step); }
  /// Reports that the particles are prepared, see when_prepared().
  void say_prepared() const;
  /// The particles of save(), their contacts and what they meet. Collective.
  void save_particles(std::ostream &out, dem::StateExtent extent) const;
  /// The first event and the mass that was removed, for a checkpoint.
  void save_breakage(std::ostream &out) const;
  void restore_breakage(std::istream &in);
  /// Adds a line to the log after this step.
  void say(const std::string &line) { watch.say(line); }
  /// Moves boundaries, particles and bodies by steps_in_move() steps of this
  /// length [s].
  virtual void move(double time_step) = 0;
  /// Columns of history.csv between time and counts.
  virtual std::vector<Quantity> measured() const { return {}; }
  /// Point that their moments are about [m].
  virtual dem::Vec3 moment_point() const { return dem::Vec3::Zero(); }
  /// Columns of history.csv about them and about the walls of the case.
  std::vector<Quantity> boundary_row() const;
  /// Work of gravity and of what is outside on particles and bodies [J].
  virtual double external_work() const;
  /// Energy of the bodies that are coupled to the particles.
  virtual coupling::BodyEnergy body_energy() const { return {}; }
  /// What moves around the particles, for the limit of the step.
  virtual Surroundings surroundings() const { return {}; }
  /// Breakage events since the last call, of engine and exchange.
  virtual std::vector<dem::BreakageEvent> fresh_events()
  {
    return engine().take_events();
  }

  Case parameters;
  ShapeLibrary shapes;

private:
  /// Of the particles that are there.
  dem::StepLimit limit_at_setup() const;

  std::unique_ptr<dem::Engine> owned_engine;
  bool is_shareable = false; ///< the case can be spread over ranks
  mutable int n_copies = 0;
  mutable std::unique_ptr<dem::Engine> copy; ///< gathered; null after changes
  mutable double gathering = 0.;             ///< wall-clock of copying [s]
  dem::StepLimit limit;

protected:
  StepWatch watch;
  std::string stopped_by; ///< words of a guard; empty: none
  struct FirstEvent
  {
    double time = -1., force = 0.; ///< time < 0: none so far [s], [N]
  };
  FirstEvent first_event;

private:
  RemovedMass removed;
  std::function<void()> call_prepared;
  double step = 0.; ///< [s]
};

/// The fixed step, or the longest for the lightest particle on one wall. Throws
/// InputError if the fixed one is longer.
double first_step(const Case &parameters, const dem::StepLimit &limit);

/// What of a case cannot be spread over ranks; empty: all can.
std::string needs_one_rank(const Case &parameters);
/// Throws InputError on many ranks where the case needs one.
void require_shareable(const dem::Ranks &ranks, const Case &parameters);

/// The scene of a case. Throws InputError.
std::unique_ptr<Test> make_test(const Case &parameters);
} // namespace spall
