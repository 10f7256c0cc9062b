#pragma once

#include "run/forecast.h"
#include "run/sample.h"
#include "run/step_schedule.h"
#include "run/step_watch.h"
#include "specimen/specimen.h"

#include <coupling/cycle_jump.h>
#include <coupling/exchange.h>
#include <coupling/mean_cyclic_motion.h>
#include <coupling/step_probe.h>
#include <coupling/stress_balance.h>
#include <coupling/triaxial_cell.h>

#include <functional>
#include <iosfwd>
#include <optional>

namespace spall
{
enum class Stage : std::int32_t
{
  preparation,   ///< servo walls compact the cloud
  consolidation, ///< lateral boundary and plate take over
  loading,       ///< haversine on the plate
  done
};

/// What a preparation by shortcuts has come to.
struct FastPreparation
{
  bool was_prepared = false; ///< before, so that nothing had to be done
  bool is_packed = true;     ///< else still loose, and steps will cost more
  MeanStep step = {};        ///< of the particles between the walls
};

/// The dynamic triaxial test: scene and sequence, step by step.
class Triaxial
{
public:
  /// Builds the scene. Throws InputError.
  explicit Triaxial(const Case &parameters);

  /// One step of the present stage. Throws RunFailure if preparation or
  /// consolidation do not come to rest in time or loading would begin with a
  /// step that is too long, coupling::GuardStop after a step that a guard
  /// stops at.
  void advance();

  Stage stage() const { return now; }
  double time_step() const; ///< of the particles, the next one [s]
  double window() const { return pace.step(); } ///< of the exchange [s]
  double period() const; ///< of a load cycle, a whole number of ticks [s]
  /// Ticks since the present stage began, and of one load cycle. Every run
  /// meets its ticks, whatever its steps; with a fixed step each is one.
  std::int64_t ticks() const { return pace.ticks(); }
  bool is_on_sample() const { return pace.is_on_sample(); }
  std::int64_t ticks_per_cycle() const { return cycle_ticks; }
  /// Steps since the present stage began [-].
  std::int64_t stage_steps() const { return in_stage; }
  /// Fractional load cycle; 0 before loading.
  double cycle() const;
  /// The jumps over load cycles: whoever steps the test keeps its state where
  /// one is due, and brings it back where one was too far.
  const coupling::JumpPlan &jumps() const { return plan; }
  /// Back at the state that was kept: not that far.
  void shorten_jump(const coupling::JumpPlan &refused);
  /// End of this many load cycles, whatever the case says.
  void stop_after(int cycles) { n_cycles = cycles; }
  int last_cycle() const { return n_cycles; }

  /// The row of history.csv now; `roundness` is the caller's last value.
  Sample sample(double roundness) const;

  /// Once the preparation is over: what bears the boundary's load.
  coupling::StressBalance stress_balance() const;

  const dem::Engine &engine() const { return *specimen.engine; }
  dem::Engine &engine() { return *specimen.engine; }
  const dem::SpecimenWalls &walls() const { return specimen.walls; }
  /// Null without one, and in the preparation.
  const fem::Membrane *membrane() const
  {
    return cell && cell->has_membrane() ? &cell->membrane() : nullptr;
  }
  coupling::EnclosedSpecimen enclosed() const
  {
    return {engine(), walls(), membrane()};
  }
  /// Particles and what closes the specimen; null in the preparation.
  const coupling::Exchange *exchange() const { return joined.get(); }
  const SetupStep &setup_step() const { return setup; }
  /// Of the exchange now [-]; 0 in the preparation.
  double exchange_gain() const;
  /// Gain of the exchange at setup; only with a membrane.
  const std::optional<coupling::ExchangeGain> &gain() const
  {
    return setup.gain;
  }

  /// How the preparation stands, and in the end how it ended.
  struct Prepared
  {
    dem::Vec3 stress = dem::Vec3::Zero(); ///< of each axis [Pa]
    double unbalanced_ratio = 0.;         ///< [-]
    double time = 0.;                     ///< it took [s]
    double porosity = 0.;                 ///< then [-]
    std::uint64_t hash = 0;               ///< of all that decides the specimen
    std::int64_t is_taken = 0; ///< not made in this run, but taken from a file
  };
  const Prepared &prepared() const { return preparation; }

  /// How the consolidation stands, and in the end how it ended.
  struct Consolidated
  {
    double time = 0.;       ///< it took so far [s]
    double load_error = 0.; ///< of the plate, over its load [-]
    double swing = 0.;      ///< change of that load that its motion makes [-]
    double side_error = 0.; ///< of the stress on rigid sides [-]
    double unbalanced_ratio = 0.; ///< [-]
  };
  const Consolidated &consolidated() const { return consolidation; }
  /// What a reader of the results must know, a line each.
  std::vector<std::string> warnings(const EnergyBalance &loading) const;
  /// What the steps were, and what they were chosen by.
  const StepRecord &step_record() const { return watch.state(); }
  const coupling::ProbeState &step_probe() const { return probe; }
  double watch_seconds() const { return watch.seconds(); }
  /// Wall-clock of keeping and restoring states for probes [s].
  double probe_seconds() const { return probing; }
  /// Lines for the log since the last call.
  std::vector<std::string> take_notes() { return watch.take_notes(); }
  /// Breakage events since the last call.
  std::vector<dem::BreakageEvent> take_events();
  double plate_work() const { return cell ? cell->plate().drive_work() : 0.; }

  /// Is called once, when the preparation is at rest and nothing of what
  /// follows has touched the specimen.
  void when_prepared(std::function<void()> call)
  {
    call_prepared = std::move(call);
  }
  /// What the preparation will take in all, about [s].
  double preparation_time() const;
  /// Past the preparation by shortcuts, to see what steps cost: what is
  /// measured from then on is worth nothing.
  FastPreparation fast_preparation();
  /// The specimen at that moment, bit for bit, and back from there into any
  /// test of the same preparation_text(): the test goes on with the
  /// consolidation as if it had prepared itself.
  void save_prepared(std::ostream &out) const;
  void take_prepared(std::istream &in); ///< throws std::runtime_error
  const ShapeLibrary &shapes() const { return specimen.shapes; }

  void save(std::ostream &out) const; ///< full state, bit for bit
  /// Continues a saved test of the same case; throws std::runtime_error.
  void restore(std::istream &in);

private:
  void step_stage();
  void prepare();
  void consolidate();
  bool is_consolidated();
  std::string unconsolidated_text() const;
  void begin_loading();
  void load();
  void begin_damage_cycles();
  void after_sample();
  void end_cycle();
  void extrapolate();
  void hold_load(double length);
  coupling::SlowState slow_state() const;
  void enter(Stage next);
  bool is_at_rest();
  bool is_prepared();
  void densify();
  double porosity() const;
  void finish_preparation();
  std::string unprepared_text() const;
  void hand_over();
  void place_boundaries();
  bool refines_membrane() const;
  fem::SurfaceMesh side_mesh() const;
  void build_cell();
  coupling::CoupledParticles particles();
  int steps_in_window() const;
  int steps_in_pace() const;
  Surroundings surroundings() const;
  void step_boundaries();
  void exchange_window(double window);
  void hold_plate();
  double plate_acceleration() const;
  double section() const;
  bool is_fixed() const; ///< what loads, and before it what consolidates
  TimeParameters step_rule() const;
  double longest_step() const;
  void settle_step();
  void resume_pace(const TimeParameters &then, std::int64_t ticks_then);
  void start_probe();
  void follow_probe();
  void gather(coupling::ProbeWindow &window) const;
  void close_window(coupling::ProbeWindow &window) const;
  void add_energies(Sample &sample) const;
  const dem::Plane &top_plane() const;
  void open_sides(double share);
  void put_side_away();
  double lateral_stress() const;
  double volume() const;

  Case parameters;
  Stage now = Stage::preparation;
  Specimen specimen;
  dem::BoxServo servo;
  SetupStep setup;
  StepWatch watch;
  StepSchedule pace;
  coupling::ProbeState probe;
  std::string stopped_by; ///< words of a guard; empty: none
  double probing = 0.;    ///< wall-clock of going back, for probes [s]
  std::vector<dem::BreakageEvent> held_events;
  std::int64_t cycle_ticks = 0, stage_ticks = 0;
  int n_cycles = 0;

  std::int64_t in_stage = 0;
  Prepared preparation;
  Consolidated consolidation;
  bool is_rough = false;     ///< packed by shortcuts: not asked for rest
  std::int64_t is_dense = 0; ///< the target porosity has been met
  std::function<void()> call_prepared;
  std::unique_ptr<coupling::Exchange> joined;
  coupling::TriaxialCell *cell = nullptr; ///< of `joined`
  dem::Vec3 lower = dem::Vec3::Zero(), upper = dem::Vec3::Zero();
  std::vector<std::int32_t> pressed; ///< halved quads of the membrane
  double area = 0.;                  ///< of the plate [m^2]
  double pressure = 0.;              ///< on the membrane now [Pa]
  double plane_work_gone = 0.;       ///< of the top plane before the plate [J]
  double start_height = 0.;          ///< of the specimen, loading [m]
  double start_volume = 0.;          ///< [m^3]

  coupling::JumpPlan plan;
  coupling::Pose observed_from; ///< where the observation of the motion began
  /// Of the observation before the jump.
  coupling::MeanCyclicMotion mean_motion;
  double jump_work = 0.; ///< that takes the energies over the jumps [J]
};
} // namespace spall
