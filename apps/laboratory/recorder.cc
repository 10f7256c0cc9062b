#include "laboratory/recorder.h"

#include "case/file.h"
#include "run/checkpoint.h"
#include "run/cost.h"
#include "run/event_rows.h"
#include "run/frames.h"
#include "run/ledger_rows.h"
#include "run/whole_file.h"

#include <nlohmann/json.hpp>

#include <omp.h>

namespace spall
{
namespace
{
std::string header_of(const LabTest &test)
{
  std::string header;
  for (const Quantity &one : test.row())
    header += (header.empty() ? "" : ",") + std::string(one.name);
  return header;
}
} // namespace

LabRecorder::LabRecorder(const Case &c, std::filesystem::path run_folder)
    : parameters(c), folder(std::move(run_folder)),
      started(std::chrono::steady_clock::now())
{
}

double LabRecorder::elapsed() const
{
  return std::chrono::duration<double>(std::chrono::steady_clock::now() -
                                       started)
      .count();
}

void LabRecorder::write_gradation(const LabTest &test)
{
  drawn = obtained_gradation(parameters, test.all_particles());
  if (drawn)
    write_text(folder / gradation_file, gradation_table(*drawn));
}

void LabRecorder::start(LabTest &test)
{
  write_gradation(test);
  write_text(folder / "case.prm", resolved_case(parameters));
  history.open(folder / "history.csv", header_of(test));
  events.open(folder / "events.csv", events_header(test.progress_column()));
  if (test.has_ledger())
    ledger.open(folder / "ledger.csv", ledger_header());
  write_row(test);
  if (test.engine().particles().size() > 0) // else they are still to be poured
    write_frame(test);
}

void LabRecorder::resume(LabTest &test)
{
  write_gradation(test); // before what has broken is restored
  Progressed done;
  read_checkpoint(
      folder / "checkpoint" / "state.bin", parameters,
      [&test](std::istream &in) { test.restore(in); }, done);
  write_text(folder / "case.prm", resolved_case(parameters));
  history.resume(folder / "history.csv", done.history_size);
  events.resume(folder / "events.csv", done.events_size);
  if (test.has_ledger())
    ledger.resume(folder / "ledger.csv", done.ledger_size);
  frames = present_frames(folder, done.frames);
  n_frames = done.n_frames;
  spent_before = done.spent;
}

void LabRecorder::after_step(LabTest &test)
{
  if (!prepared_at && !test.is_preparing())
    prepared_at = {processor_seconds(), elapsed()};
  const Due due = test.due();
  write_files(test);
  if (!due.row && !due.frame && !due.checkpoint)
    return;
  const double begun = elapsed();
  write_due(test, due);
  if (due.checkpoint)
    write_checkpoint(test);
  output_seconds += elapsed() - begun;
}

void LabRecorder::write_files(LabTest &test)
{
  for (const NamedText &file : test.take_files())
    write_text(folder / file.name, file.text);
}

void LabRecorder::write_due(LabTest &test, const Due &due)
{
  test.engine().synchronize();
  if (due.row)
    write_row(test);
  write_events(test);
  if (due.frame)
    write_frame(test);
}

void LabRecorder::write_row(LabTest &test)
{
  require_energy(test.energy_balance().residual, test.engine().time());
  std::vector<double> row;
  for (const Quantity &one : test.row())
    row.push_back(one.value);
  history.write_row(row);
  test.engine().begin_overlap_interval();
  if (test.exchange())
    ledger.write_row(ledger_row(*test.exchange(), test.engine(),
                                test.steps_in_move() * test.time_step()));
}

void LabRecorder::write_events(LabTest &test)
{
  for (const dem::BreakageEvent &e : test.take_events())
    events.write_row(event_row(e, test.progress_at(e.time)));
}

void LabRecorder::write_frame(const LabTest &test)
{
  spall::write_frame(folder, test.engine(), test.frame_parts(), n_frames++,
                     frames);
}

std::map<std::string, double> LabRecorder::wall_clock(const LabTest &test) const
{
  const dem::EngineClock clock = test.engine().clock();
  std::map<std::string, double> seconds = {
      {"contacts", clock.contacts},         {"search", clock.search},
      {"breakage", clock.breakage},         {"motion", clock.motion},
      {"step_watch", test.watch_seconds()}, {"output", output_seconds}};
  if (test.exchange())
  {
    const coupling::ExchangeClock around = test.exchange()->clock();
    seconds["bodies"] = around.bodies;
    seconds["transfer"] = around.transfer;
    seconds["repeating"] = around.keeping;
    seconds["guards"] = around.guards;
  }
  double known = 0.;
  for (const auto &[phase, spent] : seconds)
    known += spent;
  seconds["total"] = elapsed();
  seconds["other"] = std::max(0., seconds["total"] - known);
  seconds[processor_time] = processor_seconds();
  if (prepared_at)
  {
    seconds[loading_processor_time] =
        processor_seconds() - prepared_at->processor;
    seconds[loading_wall_time] = elapsed() - prepared_at->wall;
  }
  for (const auto &[phase, spent] : spent_before)
    seconds[phase] += spent;
  return seconds;
}

void LabRecorder::write_checkpoint(LabTest &test, const std::string &name)
{
  test.engine().synchronize();
  write_events(test);
  Progressed done;
  done.history_size = history.flushed_size();
  done.events_size = events.flushed_size();
  if (test.has_ledger())
    done.ledger_size = ledger.flushed_size();
  done.frames = frames;
  done.n_frames = n_frames;
  done.spent = wall_clock(test);
  spall::write_checkpoint(
      folder / "checkpoint" / name, parameters,
      [&test](std::ostream &out) { test.save(out); }, done);
}

void LabRecorder::finish(LabTest &test)
{
  const double begun = elapsed();
  // Before the frame: a run that goes on has none here.
  write_checkpoint(test);
  if (frames.empty() || frames.back().time != test.engine().time())
    write_frame(test);
  output_seconds += elapsed() - begun;
  nlohmann::ordered_json summary;
  summary["kind"] = kind_names[static_cast<std::size_t>(parameters.kind)];
  summary["title"] = parameters.title;
  summary["is_complete"] = test.share_done() >= 1. && !test.ends_early();
  summary["threads"] = omp_get_max_threads();
  test.summarise(summary);
  if (drawn)
    summary["gradation_error_1"] = drawn->largest_difference();
  add_energy_balance(test.reported_balance(), summary);
  if (test.exchange())
    add_ledger(*test.exchange(), summary);
  summary["warnings"] = test.warnings();
  add_cost(wall_clock(test), summary);
  summary["version"] = SPALL_VERSION;
  write_text(folder / "summary.json", summary.dump(2) + "\n");
}

std::string LabRecorder::keep_stopped(LabTest &test)
{
  const Due due = test.due();
  write_files(test);
  write_due(test, due);
  write_checkpoint(test, "stopped.bin");
  return (folder / "checkpoint" / "stopped.bin").string();
}

std::string LabRecorder::last_checkpoint() const
{
  const auto path = folder / "checkpoint" / "state.bin";
  return std::filesystem::exists(path) ? path.string() : "";
}
} // namespace spall
