#include "triaxial/recorder.h"

#include "case/file.h"
#include "errors.h"
#include "run/cost.h"
#include "run/event_rows.h"
#include "run/frames.h"
#include "run/ledger_rows.h"
#include "run/whole_file.h"

#include <algorithm>
#include <cmath>
#include <omp.h>

namespace spall
{
namespace
{
constexpr std::int64_t preparation_interval = 1000; // steps between rows

std::string history_header()
{
  std::string header;
  for (const SampleColumn &column : sample_columns)
    header += (header.empty() ? "" : ",") + std::string(column.name);
  return header;
}

std::string triaxial_ledger_header()
{
  return ledger_header() + ",membrane_work_J,plate_work_J,energy_residual_J";
}
} // namespace

Recorder::Recorder(const Case &c, std::filesystem::path run_folder)
    : parameters(c), folder(std::move(run_folder)), cycles(c, folder),
      started(std::chrono::steady_clock::now())
{
}

double Recorder::elapsed() const
{
  return std::chrono::duration<double>(std::chrono::steady_clock::now() -
                                       started)
      .count();
}

void Recorder::write_gradation(const Triaxial &test)
{
  drawn = obtained_gradation(parameters, test.engine().particles());
  if (drawn)
    write_text(folder / gradation_file, gradation_table(*drawn));
}

void Recorder::start(const Triaxial &test)
{
  write_gradation(test);
  write_text(folder / "case.prm", resolved_case(parameters));
  history.open(folder / "history.csv", history_header());
  events.open(folder / "events.csv", events_header("cycle_1"));
  if (parameters.boundary.lateral == Lateral::membrane)
    ledger.open(folder / "ledger.csv", triaxial_ledger_header());
  cycles.start();
}

/// State of the test and of the files as a checkpoint has them.
Progressed Recorder::restore_state(Triaxial &test, const std::string &name)
{
  Progressed done;
  read_checkpoint(
      folder / "checkpoint" / name, parameters,
      [&](std::istream &in)
      {
        test.restore(in);
        cycles.restore(in);
      },
      done);
  history.resume(folder / "history.csv", done.history_size);
  events.resume(folder / "events.csv", done.events_size);
  if (test.membrane())
    ledger.resume(folder / "ledger.csv", done.ledger_size);
  else if (parameters.boundary.lateral == Lateral::membrane)
    ledger.open(folder / "ledger.csv", triaxial_ledger_header());
  frames = present_frames(folder, done.frames);
  n_frames = done.n_frames;
  roundness = done.roundness;
  loading_start = done.loading_start;
  last = done.last;
  worst_gain = done.worst_gain;
  peak_axial_stress = done.peak_axial_stress;
  checkpoint_cycle = std::llround(test.cycle());
  return done;
}

void Recorder::resume(Triaxial &test)
{
  write_gradation(test); // before what has broken is restored
  spent_before = restore_state(test, "state.bin").spent;
  write_text(folder / "case.prm", resolved_case(parameters));
  stage_before = std::min(test.stage(), Stage::loading);
  follow_jumps(test); // the run may have ended before it had
}

void Recorder::follow_jumps(Triaxial &test)
{
  constexpr const char *kept = "before_jump.bin";
  if (test.jumps().due() == coupling::JumpStep::save_state)
    write_checkpoint(test, kept);
  if (test.jumps().due() != coupling::JumpStep::restore_state)
    return;
  const coupling::JumpPlan refused = test.jumps();
  restore_state(test, kept);
  test.shorten_jump(refused);
  if (!last_checkpoint().empty()) // of cycles that have not been
    write_checkpoint(test);
}

void Recorder::after_step(Triaxial &test)
{
  const double begun = elapsed();
  write_due(test);
  if (test.stage() >= Stage::loading && test.is_on_sample() &&
      test.ticks() % test.ticks_per_cycle() == 0)
    write_due_checkpoint(test, test.ticks() / test.ticks_per_cycle());
  spent.output += elapsed() - begun;
}

/// Row and frame.
void Recorder::write_due(Triaxial &test)
{
  note_stage(test);
  if (test.stage() < Stage::loading)
  {
    if (test.stage_steps() % preparation_interval == 0)
      write_history(test);
    return;
  }
  if (!test.is_on_sample())
    return;
  const std::int64_t n = test.ticks_per_cycle(), step = test.ticks();
  const auto is_due = [&](std::int64_t times)
  { return times > 0 && (step * times) / n != ((step - 1) * times) / n; };
  if (step == 0 || is_due(parameters.output.samples_per_cycle))
  {
    if (step % n == 0)
      roundness = known_roundness.mean(test.engine().particles());
    write_history(test);
    if (step == 0)
      loading_start = last;
    cycles.take(test, last);
  }
  if (is_due(2) && step % n != 0)
    cycles.take_peak(test);
  const bool is_last = test.cycle() >= parameters.loading.n_cycles();
  if (step == 0 || (is_due(parameters.output.frames_per_cycle) && !is_last))
    write_frame(test,
                step == 0 || parameters.output.surfaces == SurfaceFrames::all);
}

/// Jumps may pass the cycle that one is due at.
void Recorder::write_due_checkpoint(Triaxial &test, std::int64_t cycle)
{
  const int every = parameters.output.checkpoint_every;
  if (every == 0 || cycle / every == checkpoint_cycle / every)
    return;
  checkpoint_cycle = cycle;
  write_checkpoint(test);
}

void Recorder::note_stage(Triaxial &test)
{
  if (stage_before == Stage::preparation && test.stage() != Stage::preparation)
  {
    spent.preparation = elapsed();
    spent.preparation_processor = processor_seconds();
    spent.preparation_clock = test.engine().clock();
  }
  stage_before = test.stage();
}

void Recorder::write_history(Triaxial &test)
{
  test.engine().synchronize();
  if (roundness == 0.)
    roundness = known_roundness.mean(test.engine().particles());
  last = test.sample(roundness);
  test.engine().begin_overlap_interval();
  require_energy(last.energy_residual, last.time);
  if (test.stage() >= Stage::loading)
    peak_axial_stress = std::max(peak_axial_stress, last.axial_stress);
  std::vector<double> row;
  for (const SampleColumn &column : sample_columns)
    row.push_back(last.*column.value);
  history.write_row(row);
  write_events(test);
  write_ledger(test, last);
}

void Recorder::write_events(Triaxial &test)
{
  const double period = test.period();
  for (const dem::BreakageEvent &e : test.take_events())
  {
    // From times alone, so that it does not matter when the row is written;
    // particles break from the start of loading only.
    const double cycle = std::max(0., (e.time - loading_start.time) / period);
    events.write_row(event_row(e, cycle));
  }
}

void Recorder::write_ledger(Triaxial &test, const Sample &sample)
{
  if (!test.membrane())
    return;
  worst_gain = std::max(worst_gain, test.exchange_gain());
  std::vector<double> row =
      ledger_row(*test.exchange(), test.engine(), test.window());
  for (const double more : {test.engine().energy().work_of("facets"),
                            test.plate_work(), sample.energy_residual})
    row.push_back(more);
  ledger.write_row(row);
}

void Recorder::write_frame(Triaxial &test, bool with_surfaces)
{
  const FrameParts parts{test.membrane(),
                         with_surfaces &&
                             parameters.output.surfaces != SurfaceFrames::none};
  spall::write_frame(folder, test.engine(), parts, n_frames++, frames);
}

void Recorder::write_checkpoint(Triaxial &test, const std::string &name)
{
  test.engine().synchronize();
  write_events(test);
  Progressed done;
  done.history_size = history.flushed_size();
  done.events_size = events.flushed_size();
  if (test.membrane())
    done.ledger_size = ledger.flushed_size();
  done.frames = frames;
  done.n_frames = n_frames;
  done.roundness = roundness;
  done.loading_start = loading_start;
  done.last = last;
  done.worst_gain = worst_gain;
  done.peak_axial_stress = peak_axial_stress;
  spent.total = elapsed();
  done.spent = wall_clock(test, spent, spent_before);
  spall::write_checkpoint(
      folder / "checkpoint" / name, parameters,
      [&](std::ostream &out)
      {
        test.save(out);
        cycles.save(out);
      },
      done);
}

void Recorder::finish(Triaxial &test)
{
  const double begun = elapsed();
  if (test.cycle() >= parameters.loading.n_cycles())
  {
    cycles.finish(test);
    if (frames.empty() || frames.back().time != test.engine().time())
      write_frame(test, true);
  }
  write_checkpoint(test);
  spent.output += elapsed() - begun;
  RunRecord record;
  record.start = loading_start;
  record.end = last;
  record.worst_gain = worst_gain;
  record.peak_axial_stress = peak_axial_stress;
  record.threads = omp_get_max_threads();
  if (drawn)
    record.gradation_error = drawn->largest_difference();
  spent.total = elapsed();
  record.seconds = wall_clock(test, spent, spent_before);
  write_text(folder / "summary.json",
             summary_text(parameters, test, record, cycles));
}

std::string Recorder::keep_stopped(Triaxial &test)
{
  write_due(test);
  write_checkpoint(test, "stopped.bin");
  return (folder / "checkpoint" / "stopped.bin").string();
}

std::string Recorder::last_checkpoint() const
{
  const auto path = folder / "checkpoint" / "state.bin";
  return std::filesystem::exists(path) ? path.string() : "";
}
} // namespace spall
