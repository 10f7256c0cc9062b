#include "test/recorder.h"

#include "case/file.h"
#include "run/cost.h"
#include "run/event_rows.h"
#include "run/first_rank.h"
#include "run/frame_tables.h"
#include "run/frames.h"
#include "run/ledger_rows.h"
#include "run/whole_file.h"
#include "specimen/last_state.h"

#include <nlohmann/json.hpp>

#include <omp.h>

namespace spall
{
namespace
{
constexpr const char *history = "history.csv", *events = "events.csv",
                     *ledger = "ledger.csv";

std::string names_of(const std::vector<Quantity> &row)
{
  std::string names;
  for (const Quantity &one : row)
  {
    if (!names.empty())
      names += ',';
    names += one.name;
  }
  return names;
}

/// All tables of the test with their headers.
std::vector<TableHeader> headers_of(const Test &test)
{
  std::vector<TableHeader> all = {
      {history, names_of(test.row())},
      {events, events_header(test.progress_column())}};
  if (test.has_ledger())
  {
    const std::string own = names_of(test.own_ledger());
    all.push_back({ledger, ledger_header() + (own.empty() ? "" : ",") + own});
  }
  for (const TableHeader &table : test.tables())
    all.push_back(table);
  return all;
}

void add_values(const std::vector<Quantity> &from, std::vector<double> &row)
{
  for (const Quantity &one : from)
    row.push_back(one.value);
}
} // namespace

Recorder::Recorder(const Case &c, std::filesystem::path run_folder)
    : parameters(c), folder(std::move(run_folder)),
      started(std::chrono::steady_clock::now())
{
}

double Recorder::elapsed() const
{
  return std::chrono::duration<double>(std::chrono::steady_clock::now() -
                                       started)
      .count();
}

/// Before what has broken is restored.
void Recorder::note_gradation(const Test &test)
{
  test.with_all_particles(
      [&](const dem::ParticleSystem &particles)
      { drawn = obtained_gradation(parameters, particles); });
}

/// case.prm, and the gradation.
void Recorder::write_input() const
{
  write_text(folder / "case.prm", resolved_case(parameters));
  if (drawn)
    write_text(folder / gradation_file, gradation_table(*drawn));
}

/// Before what has broken is restored.
void Recorder::note_first_shapes(const Test &test)
{
  if (test.has_slices())
    test.with_all_particles([this](const dem::ParticleSystem &particles)
                            { first_shapes = dem::first_shapes(particles); });
}

/// slices_WHEN.csv; false: the test has no slices now.
bool Recorder::write_slices(const Test &test, const std::string &when)
{
  const std::optional<SliceSpace> space = test.slice_space();
  if (!space)
    return false;
  test.with_whole(
      [&](const dem::Engine &scene)
      {
        slices = cut_specimen(scene.particles(), first_shapes, *space);
        write_text(folder / ("slices_" + when + ".csv"), slices_table(slices));
      });
  return true;
}

std::filesystem::path Recorder::checkpoint(const std::string &name) const
{
  return folder / "checkpoint" / name;
}

void Recorder::start(Test &test)
{
  note_gradation(test);
  note_first_shapes(test);
  const std::vector<TableHeader> headers = headers_of(test);
  on_first_rank(test.ranks(),
                [&]
                {
                  write_input();
                  for (const TableHeader &table : headers)
                    tables[table.file].open(folder / table.file, table.header);
                });
  write_due(test, test.due_at_start());
}

/// State of the test and of the files as a checkpoint has them.
Progressed Recorder::restore_state(Test &test, const std::string &name)
{
  Progressed done;
  read_checkpoint(
      test.ranks(), checkpoint(name), parameters,
      [&test](std::istream &in) { test.restore(in); }, done);
  const std::vector<TableHeader> headers = headers_of(test);
  on_first_rank(test.ranks(),
                [&]
                {
                  for (const TableHeader &table : headers)
                    tables[table.file].resume(folder / table.file,
                                              done.table_sizes[table.file]);
                });
  frames = present_frames(folder, done.frames);
  framed_at.reset();
  if (!frames.empty())
    framed_at = frames.back().time;
  n_frames = done.n_frames;
  return done;
}

void Recorder::resume(Test &test)
{
  note_gradation(test);
  note_first_shapes(test);
  // Files change from here on: not before the checkpoint is that of this case.
  spent_before = restore_state(test, "state.bin").spent;
  has_first_slices = test.slice_space().has_value();
  on_first_rank(test.ranks(), [this] { write_input(); });
  follow_rewind(test); // the run may have ended before it had
}

void Recorder::follow_rewind(Test &test)
{
  constexpr const char *kept = "before_jump.bin";
  const Rewind asked = test.rewind();
  if (asked == Rewind::save_state)
    write_checkpoint(test, kept);
  if (asked != Rewind::restore_state)
    return;
  test.go_back([&] { restore_state(test, kept); });
  if (!last_checkpoint().empty()) // of steps that count no longer
    write_checkpoint(test);
}

void Recorder::note_preparation(const Test &test)
{
  if (test.is_preparing())
    has_prepared = true;
  else if (!prepared_at)
    prepared_at = {processor_seconds(), elapsed(), test.engine().clock()};
}

void Recorder::after_step(Test &test)
{
  note_preparation(test);
  const double begun = elapsed();
  const Due due = test.due();
  write_due(test, due);
  if (due.checkpoint)
    write_checkpoint(test);
  follow_rewind(test);
  output_seconds += elapsed() - begun;
}

void Recorder::write_files(Test &test)
{
  const std::vector<NamedText> files = test.take_files();
  const std::vector<TableRow> rows = test.take_table_rows();
  if (files.empty() && rows.empty())
    return;
  on_first_rank(test.ranks(),
                [&]
                {
                  for (const NamedText &file : files)
                    write_text(folder / file.name, file.text);
                  for (const TableRow &row : rows)
                    tables.at(row.file).write_row(row.values);
                });
}

void Recorder::write_due(Test &test, const Due &due)
{
  const bool is_any_due = due.row || due.frame || due.checkpoint;
  if (is_any_due)
    test.engine().synchronize();
  if (due.row)
    write_row(test);
  if (is_any_due)
    write_events(test);
  write_files(test);
  if (due.frame)
    write_frame(test);
  if (is_any_due && !has_first_slices)
    has_first_slices = write_slices(test, "start");
}

void Recorder::write_row(Test &test)
{
  std::vector<double> row;
  add_values(test.take_row(), row);
  require_energy(test.energy_balance().residual, test.engine().time());
  on_first_rank(test.ranks(), [&] { tables.at(history).write_row(row); });
  test.engine().begin_overlap_interval();
  if (!test.has_ledger() || !test.exchange())
    return;
  std::vector<double> exchanged =
      ledger_row(*test.exchange(), test.engine(), test.window());
  add_values(test.own_ledger(), exchanged);
  on_first_rank(test.ranks(), [&] { tables.at(ledger).write_row(exchanged); });
}

void Recorder::write_events(Test &test)
{
  const std::vector<dem::BreakageEvent> fresh = test.take_events();
  on_first_rank(test.ranks(),
                [&]
                {
                  for (const dem::BreakageEvent &e : fresh)
                    tables.at(events).write_row(event_row(
                        e, test.progress_column(), test.progress_at(e.time)));
                });
}

/// Whether each rank writes the particles that it owns: of a scene too large to
/// be copied for its pictures.
bool Recorder::writes_pieces(const Test &test) const
{
  return test.ranks().size() > 1 &&
         dem::total_particles(test.engine()) > parameters.output.pieces_above;
}

void Recorder::write_frame(const Test &test)
{
  if (writes_pieces(test))
    write_frame_in_pieces(folder, test.synchronized(), test.frame_parts(),
                          n_frames, frames);
  else
  {
    const FrameParts parts = test.frame_parts();
    test.with_whole(
        [&](const dem::Engine &scene)
        { spall::write_frame(folder, scene, parts, n_frames, frames); });
  }
  write_tables(test);
  ++n_frames;
  framed_at = test.engine().time();
}

/// The tables of the frame that is written next, if the case asks for them.
void Recorder::write_tables(const Test &test) const
{
  if (parameters.output.frame_tables == FrameTables::none)
    return on_first_rank(test.ranks(),
                         [&] { remove_frame_tables(folder, n_frames); });
  dem::FrameDescription frame{.title = parameters.title,
                              .kind = parameters.kind,
                              .program = SPALL_VERSION,
                              .number = n_frames,
                              .shapes = test.shape_library().series()};
  for (std::size_t k = 0; k < frame.shapes.size(); ++k)
    frame.shape_names.push_back(test.shape_library().entry(k).name);
  for (const NamedBoundary &one : test.named_boundaries())
    if (one.kind == BoundaryKind::plane)
    {
      frame.plane_names.resize(
          std::max(frame.plane_names.size(), one.number + 1));
      frame.plane_names[one.number] = one.name;
    }
  test.with_whole([&](const dem::Engine &scene)
                  { write_frame_tables(folder, scene, frame); });
}

/// By phase [s]; the phases of stepping are those after the preparation. Adds
/// what earlier programs of the same run spent. Collective.
std::map<std::string, double> Recorder::wall_clock(const Test &test) const
{
  const dem::EngineClock now = test.engine().clock(),
                         then = prepared_at ? prepared_at->engine
                                            : dem::EngineClock{};
  std::map<std::string, double> seconds = {
      {"contacts", now.contacts - then.contacts},
      {"search", now.search - then.search},
      {"breakage", now.breakage - then.breakage},
      {"motion", now.motion - then.motion},
      {"output", output_seconds}};
  if (test.ranks().size() > 1)
    seconds["exchange"] = now.exchange - then.exchange;
  if (has_prepared && prepared_at)
    seconds["preparation"] = prepared_at->wall;
  test.add_clocks(seconds);
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
  const double processor = processor_seconds();
  seconds[processor_time] = over_all_ranks(test.ranks(), processor);
  if (prepared_at)
  {
    seconds[loading_processor_time] =
        over_all_ranks(test.ranks(), processor - prepared_at->processor);
    seconds[loading_wall_time] = elapsed() - prepared_at->wall;
  }
  for (const auto &[phase, spent] : spent_before)
    seconds[phase] += spent;
  return seconds;
}

void Recorder::write_checkpoint(Test &test, const std::string &name)
{
  test.engine().synchronize();
  write_events(test);
  Progressed done;
  on_first_rank(test.ranks(),
                [&]
                {
                  for (auto &[file, table] : tables)
                    done.table_sizes[file] = table.flushed_size();
                });
  done.frames = frames;
  done.n_frames = n_frames;
  done.spent = wall_clock(test);
  spall::write_checkpoint(
      test.ranks(), checkpoint(name), parameters,
      [&test](std::ostream &out) { test.save(out, dem::StateExtent::scene); },
      done);
}

void Recorder::finish(Test &test)
{
  const double begun = elapsed();
  // Before the frame: a resumed run has none here.
  write_checkpoint(test);
  if (framed_at != test.engine().time())
    write_frame(test);
  write_last_particles(test);
  write_slices(test, "end");
  output_seconds += elapsed() - begun;
  nlohmann::ordered_json summary;
  summary["kind"] = parameters.kind;
  summary["title"] = parameters.title;
  summary["is_complete"] = test.share_done() >= 1. && !test.ends_early();
  summary["ranks"] = test.ranks().size();
  summary["threads"] = omp_get_max_threads();
  test.summarise(summary);
  if (drawn)
    summary["gradation_error_1"] = drawn->largest_difference();
  add_energy_balance(test.reported_balance(), summary);
  if (test.has_ledger() && test.exchange())
    add_ledger(*test.exchange(), summary);
  add_slices(slices, summary);
  summary["warnings"] = test.warnings();
  add_cost(test.ranks(), wall_clock(test), summary);
  summary["version"] = SPALL_VERSION;
  on_first_rank(
      test.ranks(),
      [&] { write_text(folder / "summary.json", summary.dump(2) + "\n"); });
}

void Recorder::write_last_particles(const Test &test)
{
  test.with_whole(
      [&](const dem::Engine &scene)
      { write_last_state(folder, scene.particles(), test.shape_library()); });
}

std::string Recorder::save_stopped(Test &test)
{
  write_due(test, test.due());
  write_checkpoint(test, "stopped.bin");
  return checkpoint("stopped.bin").string();
}

std::string Recorder::last_checkpoint() const
{
  const std::filesystem::path path = checkpoint("state.bin");
  return std::filesystem::exists(path) ? path.string() : "";
}
} // namespace spall
