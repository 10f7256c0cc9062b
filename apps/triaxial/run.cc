#include "errors.h"
#include "run/checkpoint.h"
#include "run/folder.h"
#include "run/options.h"
#include "run/overlap_news.h"
#include "run/preparation_store.h"
#include "run/progress.h"
#include "run/refusals.h"
#include "run/thread_choice.h"
#include "run/time_left.h"
#include "run/to_end.h"
#include "run/warnings.h"
#include "triaxial/preparation.h"
#include "triaxial/recorder.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>

namespace spall
{
namespace
{
/// What the loading has come to by the last row of the history.
std::string numbers_of(const Sample &last)
{
  char text[120];
  std::snprintf(text, sizeof text,
                "strain %.3f %%, LAA %.5f %%, coordination number %.2f",
                100. * last.axial_strain, last.laa, last.coordination_number);
  return text;
}

/// How near the preparation is to its rest.
std::string numbers_of(const Triaxial::Prepared &so_far,
                       const PreparationParameters &target)
{
  char text[120];
  const dem::Vec3 stress = 1e-3 * so_far.stress;
  std::snprintf(text, sizeof text,
                "stress %.3g %.3g %.3g of %.3g kPa, unbalanced force ratio "
                "%.1e of %.1e",
                stress.x(), stress.y(), stress.z(), 1e-3 * target.pressure,
                so_far.unbalanced_ratio, target.unbalanced_ratio);
  return text;
}

/// How long the packing, which has its stress, will take to its rest; nothing
/// where that is not known.
std::string rest_of(const Triaxial::Prepared &so_far,
                    const PreparationParameters &target, RestTime &rest,
                    double now)
{
  const bool has_its_stress =
      ((so_far.stress / target.pressure - dem::Vec3::Ones())
           .cwiseAbs()
           .array() < target.stress_tolerance)
          .all();
  if (!has_its_stress || so_far.unbalanced_ratio <= target.unbalanced_ratio)
    return "";
  const double left = rest.after(now, so_far.unbalanced_ratio);
  return std::isfinite(left) ? ", at rest in some " + in_minutes(left) : "";
}

/// Share of the preparation that is done, about, then of the load cycles. A
/// specimen that is longer on its way than expected is nearly there.
double share_done(const Triaxial &test)
{
  constexpr double nearly = 0.99;
  if (test.stage() == Stage::preparation)
    return std::min(nearly, test.engine().time() / test.preparation_time());
  return test.stage() == Stage::consolidation
             ? 0.
             : test.cycle() / test.last_cycle();
}

/// That share and the name of the phase.
void show_progress(Progress &progress, const Triaxial &test, const Sample &last,
                   const Case &parameters, double rate, RestTime &rest,
                   double now)
{
  const int cycles = test.last_cycle();
  char phase[40];
  if (test.stage() == Stage::preparation)
    std::snprintf(phase, sizeof phase, "preparation");
  else if (test.stage() == Stage::consolidation)
    std::snprintf(phase, sizeof phase, "consolidation");
  else
    std::snprintf(phase, sizeof phase, "cycle %.2f/%d", test.cycle(), cycles);
  std::string numbers;
  if (test.stage() == Stage::preparation)
    numbers = numbers_of(test.prepared(), parameters.preparation) +
              rest_of(test.prepared(), parameters.preparation, rest, now);
  else if (test.stage() >= Stage::loading)
    numbers = numbers_of(last);
  progress.show(phase, share_done(test), rate, numbers);
}

void describe(Progress &progress, const Triaxial &test)
{
  char line[200];
  const dem::StepLimit limit =
      dem::critical_step(test.engine().parameters(), test.engine().particles());
  std::snprintf(line, sizeof line,
                "%zu particles, time step %.3g s, critical %.3g s (%s)",
                test.engine().particles().size(), test.time_step(), limit.step,
                limit.reason.c_str());
  progress.say(line);
  if (!test.gain())
    return;
  std::snprintf(line, sizeof line,
                "exchange gain k dt^2/(4 m) = %.3g, stable below %.3g",
                test.gain()->gain, test.gain()->limit);
  progress.say(line);
}

void describe_preparation(Progress &progress, const Triaxial &test)
{
  char line[200];
  const Triaxial::Prepared &p = test.prepared();
  std::snprintf(line, sizeof line,
                "prepared in %.3f s: stress %.0f %.0f %.0f Pa, unbalanced "
                "force ratio %.1e, porosity %.3f",
                p.time, p.stress.x(), p.stress.y(), p.stress.z(),
                p.unbalanced_ratio, p.porosity);
  progress.say(line);
}

/// Where there is a store, what is prepared goes there, and a new run begins
/// with what is there.
void use_store(const std::optional<PreparationStore> &store, Triaxial &test,
               Progress &progress, Recorder *new_run)
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
    describe_preparation(progress, test);
    new_run->after_step(test);
  }
  else if (!said.empty())
    progress.say(said);
}

void describe_consolidation(Progress &progress, const Triaxial &test)
{
  char line[200];
  const Triaxial::Consolidated &c = test.consolidated();
  std::snprintf(line, sizeof line,
                "consolidated in %.3f s: load on the plate within %.2g %%, "
                "unbalanced force ratio %.1e",
                c.time, 100. * std::max(c.load_error, c.swing),
                c.unbalanced_ratio);
  progress.say(line);
}

void describe_end(Progress &progress, const Recorder &recorder)
{
  const Sample &end = recorder.end(), &start = recorder.start_of_loading();
  progress.say(spall::describe(loading_balance(start, end)));
  char line[240];
  std::snprintf(line, sizeof line,
                "permanent axial strain %.4f %%, LAA %.5f %%, coordination "
                "number %.3f -> %.3f, %.0f events",
                100. * end.axial_strain, end.laa, start.coordination_number,
                end.coordination_number, end.n_events);
  progress.say(line);
}

/// Steps until the test is done or a stop is asked for.
void run_loop(Triaxial &test, Recorder &recorder, Progress &progress,
              ThreadChoice &threads, const Case &parameters)
{
  using Clock = std::chrono::steady_clock;
  const auto started = Clock::now();
  auto since = started;
  RestTime rest(parameters.preparation.unbalanced_ratio);
  Refusals refusals(test.engine().n_refused_events());
  OverlapNews overlaps(test.engine());
  std::int64_t steps_before = test.engine().n_steps(), n_windows = 0;
  while (test.stage() != Stage::done && !is_stop_asked())
  {
    const Stage before = test.stage();
    threads.before_step();
    test.advance();
    threads.after_step();
    if (const std::string note = threads.take_note(); !note.empty())
      progress.say(note);
    recorder.after_step(test);
    recorder.follow_jumps(test);
    for (const std::string &note : test.take_notes())
      progress.say(note);
    if (const std::string news = refusals.news(test.engine().n_refused_events(),
                                               test.engine().time());
        !news.empty())
      progress.say(news);
    if (const std::string news = overlaps.news(test.engine()); !news.empty())
      progress.say(news);
    if (before == Stage::preparation && test.stage() != Stage::preparation)
      describe_preparation(progress, test);
    if (before == Stage::consolidation && test.stage() == Stage::loading)
      describe_consolidation(progress, test);
    if (++n_windows % 64 != 0 || !progress.is_due())
      continue;
    const auto seconds = [](Clock::duration spent)
    { return std::chrono::duration<double>(spent).count(); };
    show_progress(progress, test, recorder.end(), parameters,
                  static_cast<double>(test.engine().n_steps() - steps_before) /
                      seconds(Clock::now() - since),
                  rest, seconds(Clock::now() - started));
    since = Clock::now();
    steps_before = test.engine().n_steps();
  }
}

} // namespace

void run_triaxial(const RunOptions &asked, const Case &parameters)
{
  RunOptions options = asked;
  const std::string note = start_over_if_interrupted(options);
  const int all = parameters.loading.n_cycles(),
            cycles = options.until ? std::min(*options.until, all) : all;
  const std::filesystem::path folder = options.out;
  Triaxial test(parameters);
  test.stop_after(cycles);
  if (options.is_resumed)
    require_checkpoint(folder / "checkpoint" / "state.bin");
  std::optional<PreparationStore> store;
  if (!options.preparations.empty())
    store.emplace(options.preparations,
                  preparation_text(parameters, test.shapes()));
  prepare_run_folder(options);
  Recorder recorder(parameters, folder);
  Progress progress((folder / "log.txt").string());
  if (options.is_resumed)
  {
    recorder.resume(test);
    std::filesystem::remove(folder / "summary.json"); // of where it had ended
  }
  else
    recorder.start(test);
  if (!note.empty())
    progress.say(note);
  describe(progress, test);
  if (recorder.gradation())
    progress.say("gradation " + gradation_line(*recorder.gradation()));
  use_store(store, test, progress, options.is_resumed ? nullptr : &recorder);
  run_to_end(test, recorder,
             [&]
             {
               ThreadChoice threads(
                   options.threads.value_or(parameters.threads));
               run_loop(test, recorder, progress, threads, parameters);
               recorder.finish(test);
             });
  describe_end(progress, recorder);
  say_warnings(progress, test.warnings(loading_balance(
                             recorder.start_of_loading(), recorder.end())));
}
} // namespace spall
