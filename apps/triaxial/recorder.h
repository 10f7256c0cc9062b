#pragma once

#include "run/checkpoint.h"
#include "specimen/obtained_gradation.h"
#include "triaxial/cycles.h"
#include "triaxial/summary.h"

#include <dem/measure/roundness_book.h>

#include <chrono>
#include <filesystem>
#include <map>

namespace spall
{
/// Writes the run folder of a triaxial test: history, events, ledger, frames,
/// checkpoints and the summary.
class Recorder
{
public:
  Recorder(const Case &parameters, std::filesystem::path folder);

  /// Starts the files of a new run.
  void start(const Triaxial &test);
  /// Continues from the last checkpoint: state of the test and of the files.
  /// Throws InputError if there is none or it is of another case.
  void resume(Triaxial &test);

  /// Writes what is due after a step.
  void after_step(Triaxial &test);
  /// Keeps or brings back test and files as a jump over cycles asks for.
  void follow_jumps(Triaxial &test);
  /// Writes what a finished or stopped run leaves.
  void finish(Triaxial &test);

  /// Of the particles as drawn, after start() or resume().
  const std::optional<ObtainedGradation> &gradation() const { return drawn; }
  const Sample &start_of_loading() const { return loading_start; }
  const Sample &end() const { return last; } ///< last row of the history

  /// Writes what a run leaves that a guard has stopped: the state of this
  /// moment, beside the last checkpoint. Returns its path.
  std::string keep_stopped(Triaxial &test);

  /// Path of the last checkpoint, empty if none.
  std::string last_checkpoint() const;

private:
  void write_gradation(const Triaxial &test);
  void write_due(Triaxial &test);
  void write_history(Triaxial &test);
  void write_events(Triaxial &test);
  void write_ledger(Triaxial &test, const Sample &sample);
  void write_frame(Triaxial &test, bool with_surfaces);
  void write_checkpoint(Triaxial &test, const std::string &name = "state.bin");
  void write_due_checkpoint(Triaxial &test, std::int64_t cycle);
  Progressed restore_state(Triaxial &test, const std::string &name);
  void note_stage(Triaxial &test);
  double elapsed() const;

  Case parameters;
  std::filesystem::path folder;
  std::optional<ObtainedGradation> drawn;
  CsvFile history, events, ledger;
  CycleRecorder cycles;
  std::vector<dem::FrameEntry> frames;
  int n_frames = 0;
  std::int64_t checkpoint_cycle = 0; ///< of the last one that was due
  Stage stage_before = Stage::preparation;
  double roundness = 0.;
  dem::RoundnessBook known_roundness;
  Sample loading_start, last;
  double worst_gain = 0.;        ///< of the exchange so far [-]
  double peak_axial_stress = 0.; ///< while loading, so far [Pa]
  RecordedTime spent;
  std::map<std::string, double> spent_before; ///< wall-clock before a restart
  std::chrono::steady_clock::time_point started;
};
} // namespace spall
