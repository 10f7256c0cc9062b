#pragma once

#include "laboratory/test.h"
#include "run/csv_file.h"
#include "specimen/obtained_gradation.h"

#include <dem/io/vtk_output.h>

#include <chrono>
#include <filesystem>
#include <map>
#include <optional>

namespace spall
{
/// Writes the run folder of a LabTest: history, events, frames, checkpoints and
/// the summary.
class LabRecorder
{
public:
  LabRecorder(const Case &parameters, std::filesystem::path folder);

  /// Starts the files of a new run with the first row and frame.
  void start(LabTest &test);
  /// Continues from the last checkpoint: state of the test and of the files.
  /// Throws InputError if there is none or it is of another case.
  void resume(LabTest &test);
  /// Writes what is due after a step.
  void after_step(LabTest &test);
  /// Writes what a finished or stopped run leaves.
  void finish(LabTest &test);
  /// As Recorder::keep_stopped.
  std::string keep_stopped(LabTest &test);

  int n_written() const { return n_frames; } ///< frames
  /// Of the particles as drawn, after start() or resume(); empty for a kind
  /// without gradation.
  const std::optional<ObtainedGradation> &gradation() const { return drawn; }

  /// Path of the last checkpoint, empty if none.
  std::string last_checkpoint() const;

private:
  void write_gradation(const LabTest &test);
  void write_files(LabTest &test);
  void write_due(LabTest &test, const Due &due);
  void write_row(LabTest &test);
  void write_events(LabTest &test);
  void write_frame(const LabTest &test);
  void write_checkpoint(LabTest &test, const std::string &name = "state.bin");
  std::map<std::string, double> wall_clock(const LabTest &test) const;
  double elapsed() const;

  Case parameters;
  std::filesystem::path folder;
  std::optional<ObtainedGradation> drawn;
  CsvFile history, events, ledger;
  std::vector<dem::FrameEntry> frames;
  int n_frames = 0;
  double output_seconds = 0.;
  /// Once prepared [s].
  struct Spent
  {
    double processor, wall;
  };
  std::optional<Spent> prepared_at;
  std::map<std::string, double> spent_before; ///< wall-clock before a restart
  std::chrono::steady_clock::time_point started;
};
} // namespace spall
