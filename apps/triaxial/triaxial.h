#pragma once

#include "run/step_schedule.h"
#include "run/time_left.h"
#include "specimen/specimen.h"
#include "test/test.h"
#include "triaxial/cycles.h"
#include "triaxial/load_follower.h"
#include "triaxial/sample.h"

#include <coupling/cycle_jump.h>
#include <coupling/exchange.h>
#include <coupling/mean_cyclic_motion.h>
#include <coupling/step_probe.h>
#include <coupling/stress_balance.h>
#include <coupling/triaxial_cell.h>
#include <dem/measure/roundness_book.h>
#include <dem/particles/density_scaling.h>

#include <functional>
#include <iosfwd>
#include <optional>

namespace spall
{
enum class Stage : std::int32_t
{
  preparation,   ///< servo walls compact the cloud
  consolidation, ///< lateral boundary and plate take over
  loading,       ///< along the stages of the loading path
  done
};

/// The dynamic triaxial test: scene and sequence, step by step.
class Triaxial : public Test
{
public:
  /// Builds the scene. Throws InputError.
  explicit Triaxial(const Case &parameters);

  /// One step of the present stage. Throws RunFailure if preparation or
  /// consolidation do not come to rest in time or loading would begin with a
  /// step that is too long, coupling::GuardStop after a step that a guard
  /// stops at.
  void advance() override;

  Stage stage() const { return now; }
  double share_done() const override;
  double duration() const override; ///< without the preparation [s]
  double
  period() const override; ///< of a load cycle, a whole number of intervals [s]
  std::string phase() const override;
  std::string live_numbers() override;
  std::string outcome() const override;
  Due due() const override { return due_now; }
  Due due_at_start() const override { return {}; }
  double progress_at(double time) const override; ///< load cycles [-]
  const char *progress_column() const override { return "cycle_1"; }

  double time_step() const override; ///< of the particles, the next one [s]
  double window() const override { return schedule.step(); }
  int steps_in_move() const override;
  /// Sampling intervals since the present stage began (of the loading path,
  /// once it is loaded), and of one load cycle. Every run meets its intervals,
  /// whatever its steps; with a fixed step each is one.
  std::int64_t intervals() const { return schedule.intervals(); }
  std::int64_t intervals_per_cycle() const { return cycle_intervals; }
  /// Fractional load cycle; 0 before loading.
  double cycle() const;
  const LoadFollower &load_path() const { return follower; }
  /// No step of the loading has been.
  bool is_at_start() const
  {
    return follower.index() == 0 && schedule.intervals() == 0;
  }
  /// Load cycles of the present stage of the loading path.
  double cycles_of_stage() const;
  /// All stages of the loading path have been.
  bool is_complete() const { return follower.is_last() && follower.is_over(); }
  /// End of this many load cycles, instead of that of the case.
  void stop_after(int cycles) override;
  bool ends_early() const override { return !is_complete(); }

  /// A jump over load cycles saves the state where it is due, and restores
  /// it where it was too far.
  Rewind rewind() const override;
  void go_back(const std::function<void()> &restore) override;

  /// The row of history.csv now; `roundness` is the last value of the caller.
  Sample sample(double roundness) const;
  std::vector<Quantity> row() const override;
  std::vector<Quantity> take_row() override;
  std::vector<Quantity> own_ledger() const override;
  std::vector<std::string> warnings() const override;
  std::vector<TableHeader> tables() const override { return cycles.tables(); }
  std::vector<TableRow> take_table_rows() override
  {
    return cycles.take_rows();
  }
  std::vector<NamedText> take_files() override { return cycles.take_files(); }
  FrameParts frame_parts() const override;
  bool has_slices() const override { return true; }
  std::optional<SliceSpace> slice_space() const override;
  EnergyBalance energy_balance() const override;
  EnergyBalance reported_balance() const override; ///< of the loading
  void summarise(nlohmann::ordered_json &summary) const override;
  void add_clocks(std::map<std::string, double> &seconds) const override;

  /// Once the preparation is over: what bears the boundary's load.
  coupling::StressBalance stress_balance(const dem::Engine &scene) const;

  const dem::SpecimenWalls &walls() const { return box; }
  /// Null without one, and in the preparation.
  const fem::Membrane *membrane() const
  {
    return cell && cell->has_membrane() ? &cell->membrane() : nullptr;
  }
  /// The specimen as a scene of it has its particles.
  coupling::EnclosedSpecimen enclosed(const dem::Engine &scene) const
  {
    return {scene, walls(), membrane()};
  }
  /// Only with a membrane.
  bool has_ledger() const override
  {
    return parameters.boundary.lateral == Lateral::membrane;
  }
  /// Particles and what closes the specimen; null in the preparation.
  const coupling::Exchange *exchange() const override { return joined.get(); }
  const SetupStep *setup_step() const override { return &setup; }

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
    double time = 0.;         ///< it took so far [s]
    double load_error = 0.;   ///< of the plate, over its load [-]
    double motion_error = 0.; ///< change of that load that its motion makes [-]
    double side_error = 0.;   ///< of the stress on rigid sides [-]
    double unbalanced_ratio = 0.; ///< [-]
  };
  const Consolidated &consolidated() const { return consolidation; }
  void describe() const override;
  void describe_time(const MeanStep &step) const override;

  std::string preparation_text() const override;
  bool is_preparing() const override { return now == Stage::preparation; }
  double preparation_time() const override;
  FastPreparation fast_preparation() override;
  void save_prepared(std::ostream &out) const override;
  void take_prepared(std::istream &in) override;

  void save(std::ostream &out, dem::StateExtent extent) const override;
  void restore(std::istream &in) override;
  std::vector<NamedBoundary> named_boundaries() const override;

private:
  /// Largest stresses of the rows of the loading: axial a, lateral l.
  struct Strength
  {
    double deviator = 0.;       ///< largest q = a - l [Pa]
    double strain = 0.;         ///< axial, at the largest q [-]
    double stress_ratio = 0.;   ///< largest q / p, p = (a + 2 l) / 3 [-]
    double friction_angle = 0.; ///< largest asin((a - l) / (a + l)) [rad]
    void take(const Sample &row);
  };

  /// Numbers of the history that the test stores; plain data for the
  /// checkpoint.
  struct Recorded
  {
    Sample loading_start, last;    ///< rows
    double roundness = 0.;         ///< the last one [-]
    double worst_gain = 0.;        ///< of the exchange [-]
    double peak_axial_stress = 0.; ///< while loading [Pa]
    Strength strength;
    /// Of particles and membrane on the plate, where loading begins [Pa].
    double plate_stress = 0.;
    std::int64_t checkpoint_cycle = 0; ///< of the last one that was due
  };

  Triaxial(const Case &parameters, Specimen specimen);
  void move(double time_step) override;
  bool is_gathered() const override;
  dem::Vec3 moment_point() const override; ///< middle of the base
  std::vector<dem::BreakageEvent> fresh_events() override;
  void note_due();
  void begin_record();
  double exchange_gain() const;
  double pressed_share() const;
  double inertial_number() const;
  std::string prepared_text() const;
  std::string scaling_text() const;
  void note_prepared(); ///< for the log
  std::string preparation_numbers();
  std::string consolidated_text() const;
  void shorten_jump(const coupling::JumpPlan &refused);
  void observe();
  void prepare();
  void consolidate();
  bool is_consolidated();
  std::string unconsolidated_text() const;
  void begin_loading();
  void begin_stage();
  void begin_next_stage();
  void load();
  void load_plate(const LoadMeasures &now_measured, const StagePosition &end);
  void load_sides(const LoadMeasures &now_measured);
  void end_interval();
  bool is_at_end() const;
  bool is_interval_due(std::int64_t times) const;
  std::int64_t intervals_in(double period) const;
  StagePosition stage_position() const;
  LoadMeasures load_measures(bool with_volume) const;
  void add_balance_warning(std::vector<std::string> &all) const;
  void add_peak_warning(std::vector<std::string> &all) const;
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
  Surroundings surroundings() const override;
  void step_boundaries();
  void exchange_window(double window);
  void hold_plate();
  double section() const;
  bool is_fixed() const; ///< what loads, and before it what consolidates
  TimeParameters step_rule() const;
  double longest_step() const;
  void settle_step();
  void resume_schedule(const TimeParameters &then, std::int64_t intervals_then);
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

  Stage now = Stage::preparation;
  dem::SpecimenWalls box;
  dem::BoxServo servo;
  SetupStep setup;
  dem::DensityScaling scaling; ///< of the specimen as it is drawn
  LoadFollower follower;
  StepSchedule schedule;
  coupling::ProbeState probe;
  double probing = 0.; ///< wall-clock of going back, for probes [s]
  std::vector<dem::BreakageEvent> held_events;
  std::int64_t cycle_intervals = 0, stage_intervals = 0;
  int n_cycles = 0; ///< load cycles at which the run stops

  std::int64_t in_stage = 0;
  Prepared preparation;
  Consolidated consolidation;
  bool is_rough = false;     ///< fast preparation: rest is not required
  std::int64_t is_dense = 0; ///< the target porosity has been met
  std::unique_ptr<coupling::Exchange> joined;
  coupling::TriaxialCell *cell = nullptr; ///< of `joined`
  dem::Vec3 lower = dem::Vec3::Zero(), upper = dem::Vec3::Zero();
  std::vector<std::int32_t> pressed; ///< halved quads of the membrane
  double area = 0.;                  ///< of the plate [m^2]
  double pressure = 0.;              ///< on the membrane now [Pa]
  double plane_work_gone = 0.;       ///< of the top plane before the plate [J]
  double start_height = 0.;          ///< of the specimen, loading [m]
  double start_volume = 0.;          ///< [m^3]
  dem::Vec3 start_size = dem::Vec3::Zero(); ///< of the walls then [m]

  coupling::JumpPlan plan;
  /// Where the observation of the motion began; on the first rank.
  coupling::Pose observed_from;
  /// Of the observation before the jump.
  coupling::MeanCyclicMotion mean_motion;
  double jump_work = 0.; ///< that takes the energies over the jumps [J]

  CycleRecorder cycles;
  Recorded recorded;
  Due due_now;
  mutable dem::RoundnessBook known_roundness;
  RestTime rest;      ///< of the preparation, for the progress line
  Stopwatch run_time; ///< the same
};
} // namespace spall
