#pragma once

#include "run/csv_file.h"
#include "specimen/obtained_gradation.h"
#include "test/checkpoint.h"
#include "test/slices.h"
#include "test/test.h"

#include <dem/io/vtk_output.h>

#include <chrono>
#include <filesystem>
#include <map>
#include <optional>

namespace spall
{
/// Writes the run folder of a test: history, events, further tables, frames,
/// checkpoints and the summary.
class Recorder
{
public:
  Recorder(const Case &parameters, std::filesystem::path folder);

  /// Starts the files of a new run with what is due then.
  void start(Test &test);
  /// Continues from the last checkpoint: state of the test and of the files.
  /// Throws InputError if there is none or it is of another case.
  void resume(Test &test);
  /// Writes what is due after a step, and saves or restores the state where
  /// the test requests it.
  void after_step(Test &test);
  /// Writes what a finished or stopped run leaves.
  void finish(Test &test);
  /// Writes what a run leaves that a guard has stopped: the state of this
  /// moment, beside the last checkpoint. Returns its path.
  std::string save_stopped(Test &test);

  int n_written() const { return n_frames; } ///< frames
  /// Of the particles as drawn, after start() or resume(); empty for a kind
  /// without gradation.
  const std::optional<ObtainedGradation> &gradation() const { return drawn; }

  /// Path of the last checkpoint, empty if none.
  std::string last_checkpoint() const;

private:
  std::filesystem::path checkpoint(const std::string &name) const;
  void note_gradation(const Test &test);
  void write_input() const;
  void note_first_shapes(const Test &test);
  bool write_slices(const Test &test, const std::string &when);
  void write_files(Test &test);
  void write_due(Test &test, const Due &due);
  void write_row(Test &test);
  void write_events(Test &test);
  bool writes_pieces(const Test &test) const;
  void write_frame(const Test &test);
  void write_tables(const Test &test) const;
  void write_last_particles(const Test &test);
  void write_checkpoint(Test &test, const std::string &name = "state.bin");
  Progressed restore_state(Test &test, const std::string &name);
  void follow_rewind(Test &test);
  void note_preparation(const Test &test);
  std::map<std::string, double> wall_clock(const Test &test) const;
  double elapsed() const;

  Case parameters;
  std::filesystem::path folder;
  std::optional<ObtainedGradation> drawn;
  std::vector<dem::FirstShape> first_shapes; ///< by id, of a test with slices
  bool has_first_slices = false;             ///< slices_start.csv is written
  std::vector<SpecimenSlice> slices;         ///< the last, on the first rank
  std::map<std::string, CsvFile> tables;     ///< by file name
  std::vector<dem::FrameEntry> frames;
  int n_frames = 0;
  std::optional<double> framed_at; ///< time of the last frame [s]
  double output_seconds = 0.;
  /// Clocks when the preparation had ended.
  struct Spent
  {
    double processor = 0., wall = 0.; ///< [s]
    dem::EngineClock engine;
  };
  std::optional<Spent> prepared_at;
  bool has_prepared = false; ///< the preparation was run by this program
  std::map<std::string, double> spent_before; ///< wall-clock before a restart
  std::chrono::steady_clock::time_point started;
};
} // namespace spall
