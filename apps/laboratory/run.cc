#include "errors.h"
#include "laboratory/recorder.h"
#include "run/checkpoint.h"
#include "run/folder.h"
#include "run/options.h"
#include "run/overlap_news.h"
#include "run/preparation_store.h"
#include "run/progress.h"
#include "run/quantity_name.h"
#include "run/refusals.h"
#include "run/thread_choice.h"
#include "run/to_end.h"
#include "run/warnings.h"

#include <algorithm>
#include <cstdio>
#include <optional>
#include <string_view>

namespace spall
{
namespace
{
void describe(Progress &progress, const LabTest &test)
{
  char line[200];
  const dem::StepLimit &limit = test.step_limit();
  std::snprintf(line, sizeof line,
                "%zu bodies, time step %.3g s, at most %.3g s (%s)",
                test.all_particles().size(), test.time_step(), limit.step,
                limit.reason.c_str());
  progress.say(line);
}

void describe_end(Progress &progress, const LabTest &test)
{
  progress.say(spall::describe(test.reported_balance()));
  progress.say(test.phase() + ": " + test.outcome());
  say_warnings(progress, test.warnings());
}

/// Where there is a store for tests of this kind, what is prepared goes there,
/// and a new run begins with what is there.
void use_store(const std::optional<PreparationStore> &store, LabTest &test,
               Progress &progress, LabRecorder *new_run)
{
  if (!store)
    return;
  test.when_prepared(
      [&]
      {
        progress.say(store->keep([&test](std::ostream &out)
                                 { test.save_prepared(out); }));
      });
  std::string said;
  if (!new_run)
    return;
  if (store->take([&test](std::istream &in) { test.take_prepared(in); }, said))
  {
    progress.say("preparation taken from " + store->path().string());
    new_run->after_step(test);
  }
  else if (!said.empty())
    progress.say(said);
}

/// What a test of each kind is run for, of its row of the history.
constexpr const char *live_columns[] = {
    "force_N",           "settlement_m", "plate_settlement_m",
    "density_kg_per_m3", "laa_percent",  "n_events_1"};

std::string live_numbers(const LabTest &test)
{
  std::string numbers;
  for (const Quantity &one : test.row())
  {
    if (std::ranges::find(live_columns, std::string_view(one.name)) ==
        std::end(live_columns))
      continue;
    const QuantityName name = quantity_name(one.name);
    char text[80];
    std::snprintf(text, sizeof text, "%s%s %.4g%s%s",
                  numbers.empty() ? "" : ", ", name.words.c_str(), one.value,
                  name.unit == "–" ? "" : " ",
                  name.unit == "–" ? "" : name.unit.c_str());
    numbers += text;
  }
  return numbers;
}

/// Steps until the test is done or a stop is asked for.
void run_loop(LabTest &test, LabRecorder &recorder, Progress &progress,
              ThreadChoice &threads)
{
  using Clock = std::chrono::steady_clock;
  auto since = Clock::now();
  Refusals refusals(test.engine().n_refused_events());
  OverlapNews overlaps(test.engine());
  std::int64_t steps_before = test.engine().n_steps();
  while (test.share_done() < 1. && !is_stop_asked())
  {
    threads.before_step();
    test.advance();
    threads.after_step();
    if (const std::string note = threads.take_note(); !note.empty())
      progress.say(note);
    recorder.after_step(test);
    for (const std::string &note : test.take_notes())
      progress.say(note);
    if (const std::string news = refusals.news(test.engine().n_refused_events(),
                                               test.engine().time());
        !news.empty())
      progress.say(news);
    if (const std::string news = overlaps.news(test.engine()); !news.empty())
      progress.say(news);
    if (test.engine().n_steps() % 64 != 0 || !progress.is_due())
      continue;
    const double seconds =
        std::chrono::duration<double>(Clock::now() - since).count();
    test.engine().synchronize();
    progress.show(test.phase(), test.share_done(),
                  static_cast<double>(test.engine().n_steps() - steps_before) /
                      seconds,
                  live_numbers(test));
    since = Clock::now();
    steps_before = test.engine().n_steps();
  }
}
} // namespace

void run_lab(const RunOptions &asked, const Case &parameters)
{
  RunOptions options = asked;
  const std::string note = start_over_if_interrupted(options);
  const std::filesystem::path folder = options.out;
  const std::unique_ptr<LabTest> test = make_lab_test(parameters);
  if (options.until)
    test->stop_after(*options.until);
  if (options.is_resumed)
    require_checkpoint(folder / "checkpoint" / "state.bin");
  std::optional<PreparationStore> store;
  if (const std::string text = test->preparation_text();
      !options.preparations.empty() && !text.empty())
    store.emplace(options.preparations, text);
  prepare_run_folder(options);
  LabRecorder recorder(parameters, folder);
  Progress progress((folder / "log.txt").string());
  if (options.is_resumed)
  {
    recorder.resume(*test);
    std::filesystem::remove(folder / "summary.json"); // of where it had ended
  }
  else
    recorder.start(*test);
  if (!note.empty())
    progress.say(note);
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
