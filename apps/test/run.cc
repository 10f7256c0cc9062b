#include "case/file.h"
#include "errors.h"
#include "run/first_rank.h"
#include "run/folder.h"
#include "run/folder_lock.h"
#include "run/options.h"
#include "run/overlap_news.h"
#include "run/progress.h"
#include "run/refusals.h"
#include "run/thread_choice.h"
#include "run/warnings.h"
#include "test/checkpoint.h"
#include "test/preparation_store.h"
#include "test/recorder.h"
#include "test/to_end.h"

#include <dem/parallel/mpi_ranks.h>

#include <chrono>
#include <cstdio>
#include <optional>

namespace spall
{
namespace
{
void describe(Progress &progress, const Test &test)
{
  char line[200];
  const dem::StepLimit &limit = test.step_limit();
  std::snprintf(
      line, sizeof line, "%zu particles, time step %.3g s, at most %.3g s (%s)",
      test.n_particles(), test.time_step(), limit.step, limit.reason.c_str());
  progress.say(line);
  const SetupStep *setup = test.setup_step();
  if (!setup || !setup->gain)
    return;
  std::snprintf(line, sizeof line,
                "exchange gain k dt^2/(4 m) = %.3g, stable below %.3g",
                setup->gain->gain, setup->gain->limit);
  progress.say(line);
}

void describe_end(Progress &progress, const Test &test)
{
  progress.say(spall::describe(test.reported_balance()));
  progress.say(test.phase() + ": " + test.outcome());
  say_warnings(progress, test.warnings());
}

void say_notes(Test &test, Progress &progress)
{
  for (const std::string &note : test.take_notes())
    progress.say(note);
}

/// Where there is a store for tests of this kind, what is prepared goes there,
/// and a new run begins with what is there.
void use_store(const std::optional<PreparationStore> &store, Test &test,
               Progress &progress, Recorder *new_run)
{
  if (!store)
    return;
  test.when_prepared(
      [&]
      {
        progress.say(store->store(test.ranks(), [&test](std::ostream &out)
                                  { test.save_prepared(out); }));
      });
  std::string said;
  if (!new_run)
    return;
  if (store->take(
          test.ranks(), [&test](std::istream &in) { test.take_prepared(in); },
          said))
  {
    progress.say("preparation taken from " + store->path().string());
    say_notes(test, progress);
    new_run->after_step(test);
  }
  else if (!said.empty())
    progress.say(said);
}

/// What is worth a line of the log besides the notes of the test. Its functions
/// are collective.
class News
{
public:
  explicit News(const dem::Engine &engine)
      : refusals(engine.n_refused_events()), overlaps(engine)
  {
  }

  void say(const dem::Engine &engine, Progress &progress)
  {
    for (const std::string &line :
         {refusals.news(engine.n_refused_events(), engine.time()),
          overlaps.news(engine)})
      if (!line.empty())
        progress.say(line);
  }

private:
  Refusals refusals;
  OverlapNews overlaps;
};

/// Rate of steps between two lines of progress.
class StepRate
{
public:
  explicit StepRate(std::int64_t n_steps) : steps_before(n_steps) {}

  /// Since the last call [1/s].
  double take(std::int64_t n_steps)
  {
    const Clock::time_point now = Clock::now();
    const double rate = static_cast<double>(n_steps - steps_before) /
                        std::chrono::duration<double>(now - before).count();
    before = now;
    steps_before = n_steps;
    return rate;
  }

private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point before = Clock::now();
  std::int64_t steps_before;
};

/// Whether a stop was requested: where there are many ranks all of them learn
/// it at the same step, some time after one was told.
bool is_stopped(const dem::Ranks &ranks, std::int64_t n_steps)
{
  constexpr std::int64_t interval = 16;
  if (ranks.size() == 1)
    return is_stop_asked();
  if (n_steps % interval != 0 || !on_any_rank(ranks, is_stop_asked()))
    return false;
  request_stop();
  return true;
}

/// Steps until the test is done or a stop is requested. Decides on what all
/// ranks know.
void run_loop(Test &test, Recorder &recorder, Progress &progress,
              ThreadChoice &threads)
{
  constexpr std::int64_t interval_of_news = 64;
  News news(test.engine());
  StepRate rate(test.engine().n_steps());
  for (std::int64_t n = 1;
       test.share_done() < 1. && !is_stopped(test.ranks(), n); ++n)
  {
    threads.before_step(test.engine());
    test.advance();
    threads.after_step(test.engine());
    if (const std::string note = threads.take_note(); !note.empty())
      progress.say(note);
    recorder.after_step(test);
    say_notes(test, progress);
    if (n % interval_of_news != 0)
      continue;
    news.say(test.engine(), progress);
    if (!on_any_rank(test.ranks(), progress.is_due()))
      continue;
    test.engine().synchronize();
    progress.show(test.phase(), test.share_done(),
                  rate.take(test.engine().n_steps()), test.live_numbers());
  }
  news.say(test.engine(), progress);
}

/// What a resumed run will compute with other values than before.
std::vector<std::string> changes_of(const std::filesystem::path &folder,
                                    const Case &parameters)
{
  const std::filesystem::path before = folder / "case.prm";
  return std::filesystem::exists(before)
             ? changes_since(before.string(), parameters)
             : std::vector<std::string>{};
}

/// What is to be known of the folder before any file is made; a note for the
/// log.
std::string look_at_folder(const dem::Ranks &ranks, RunOptions &options)
{
  std::string note;
  on_first_rank(ranks, [&] { note = start_over_if_interrupted(options); });
  options.is_resumed =
      on_any_rank(ranks, ranks.rank() == 0 && options.is_resumed);
  return dem::of_first_rank(ranks, note);
}
} // namespace

void run_test(const RunOptions &asked, const Case &parameters)
{
  const std::shared_ptr<dem::Ranks> ranks = dem::ranks_of_program();
  require_shareable(*ranks, parameters);
  RunOptions options = asked;
  const std::filesystem::path folder = options.out;
  std::optional<FolderLock> lock; // on the first rank
  on_first_rank(*ranks,
                [&]
                {
                  if (std::filesystem::is_directory(folder))
                    lock.emplace(folder);
                });
  const std::string note = look_at_folder(*ranks, options);
  const std::unique_ptr<Test> test = make_test(parameters);
  if (options.until)
    test->stop_after(*options.until);
  if (options.is_resumed)
    require_checkpoint(folder / "checkpoint" / "state.bin");
  std::optional<PreparationStore> store;
  if (const std::string text = test->preparation_text();
      !options.preparations.empty() && !text.empty())
    store.emplace(options.preparations, text);
  on_first_rank(*ranks,
                [&]
                {
                  prepare_run_folder(options);
                  if (!lock)
                    lock.emplace(folder);
                });
  Recorder recorder(parameters, folder);
  Progress progress(ranks->rank() == 0 ? (folder / "log.txt").string() : "");
  if (options.is_resumed)
  {
    std::vector<std::string> changes;
    on_first_rank(*ranks, [&] { changes = changes_of(folder, parameters); });
    recorder.resume(*test);
    on_first_rank(*ranks,
                  [&] // of where it had ended
                  { std::filesystem::remove(folder / "summary.json"); });
    for (const std::string &change : changes)
      progress.say("resumed with " + change);
  }
  else
    recorder.start(*test);
  if (!note.empty())
    progress.say(note);
  for (const std::string &notice : parameters.notices)
    progress.say("note: " + notice);
  describe(progress, *test);
  if (recorder.gradation())
    progress.say("gradation " + gradation_line(*recorder.gradation()));
  use_store(store, *test, progress, options.is_resumed ? nullptr : &recorder);
  run_to_end(*test, recorder,
             [&]
             {
               ThreadChoice threads(
                   options.threads.value_or(parameters.threads));
               run_loop(*test, recorder, progress, threads);
               recorder.finish(*test);
             });
  describe_end(progress, *test);
}
} // namespace spall
