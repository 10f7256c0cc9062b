#include "case/file.h"
#include "case/parameter_json.h"
#include "commands/commands.h"
#include "errors.h"
#include "run/cost.h"
#include "run/folder.h"
#include "run/forecast.h"
#include "run/rank_share.h"
#include "run/scratch_folder.h"
#include "run/thread_choice.h"
#include "test/preparation_store.h"
#include "test/recorder.h"
#include "test/to_end.h"

#include <dem/parallel/mpi_ranks.h>

#include <array>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <omp.h>
#include <optional>

namespace spall
{
namespace
{
/// The folder of `--preparations`, if it exists.
std::optional<PreparationStore> find_store(const std::string &folder,
                                           const std::string &text)
{
  if (folder.empty() || text.empty() || !std::filesystem::is_directory(folder))
    return {};
  return PreparationStore(folder, text);
}

/// A folder for a run that is over soon and then forgotten.
std::filesystem::path run_folder_in(const ScratchFolder &scratch)
{
  RunOptions options;
  options.out = scratch.path();
  prepare_run_folder(options);
  return scratch.path();
}

/// What steps of the whole test will take with all that is written meanwhile;
/// at the end what a run leaves is written, so that memory has been as high as
/// it will be. Nearly all the time of that is the last frame.
MeanStep run_a_while(const Case &parameters, Test &test, Recorder &writer,
                     const TestTimes &times)
{
  const auto advance = [&]
  {
    try
    {
      test.advance();
    }
    catch (const coupling::GuardStop &)
    {
      return false; // particles that are packed roughly may come to that
    }
    catch (const dem::OverlapStop &stop)
    {
      throw RunFailure(overlap_text(stop, test));
    }
    writer.after_step(test);
    return test.share_done() < 1.;
  };
  MeanStep step = time_steps(test.engine(), times, parameters.threads, advance);
  const Stopwatch watch;
  writer.finish(test);
  step.cost +=
      step.unseen_frames * watch.seconds() * step.length / times.duration;
  return step;
}

/// Takes the preparation if it is in the store, and reports it.
void take_kept(const std::optional<PreparationStore> &store, Test &test)
{
  if (!store)
    return;
  std::string said;
  if (store->take(
          test.ranks(), [&test](std::istream &in) { test.take_prepared(in); },
          said))
    said = store->path();
  std::printf("preparation      %s\n",
              said.empty() ? "none of this kept" : said.c_str());
}

/// Of the rank that needs most.
void print_memory(const dem::Ranks &ranks)
{
  std::array peak{memory_use().peak};
  ranks.max(peak);
  std::printf("memory           %.0f MiB%s\n", peak[0] / (1024. * 1024.),
              ranks.size() > 1 ? " of a rank at most" : "");
}

/// How the particles are spread now.
void print_ranks(const dem::Engine &engine)
{
  const RankShare share = rank_share(engine);
  if (share.n_ranks > 1)
    std::printf("ranks            %d, of %.0f to %.0f particles and at most "
                "%.0f ghosts, %.1f kB in a step, imbalance %.3f\n",
                share.n_ranks, share.fewest_particles, share.most_particles,
                share.most_ghosts, 1e-3 * share.most_bytes, share.imbalance);
}

void print_particles(const dem::ParticleSystem &particles)
{
  double smallest = particles.radius(0), largest = smallest, mass = 0.;
  std::size_t n_breakable = 0;
  for (std::size_t i = 0; i < particles.size(); ++i)
  {
    smallest = std::min(smallest, particles.radius(i));
    largest = std::max(largest, particles.radius(i));
    mass += particles.solid_mass(i);
    n_breakable += particles.is_breakable[i];
  }
  std::printf(
      "particles           %zu, %zu breakable, diameter %.4g to %.4g m, "
      "%.4g kg\n",
      particles.size(), n_breakable, 2. * smallest, 2. * largest, mass);
}

void print_gradation(const Case &parameters,
                     const dem::ParticleSystem &particles)
{
  if (const auto drawn = obtained_gradation(parameters, particles))
    std::printf("gradation        %s\n", gradation_line(*drawn).c_str());
}

/// The gain that counts, what the ways of exchange stand, and which to take.
void print_exchange(const SetupStep &setup, int particle_steps)
{
  const coupling::ExchangeGain &gain = *setup.gain;
  const coupling::WindowGain &window = setup.window;
  std::printf("exchange gain    %.4g, stable below %.4g\n", gain.gain,
              gain.limit);
  std::printf("of a window      %.4g: one_pass below %.4g, iterated without "
              "relaxation below %.4g, best constant relaxation %.3g\n",
              window.gain, window.one_pass_limit, window.unrelaxed_limit,
              window.best_relaxation);
  std::printf("body alone       explicit steps of at most %.4g s\n",
              setup.membrane_step);
  const char *advice = "iterated with aitken";
  const bool is_mild = window.gain < 0.5 * window.one_pass_limit;
  if (is_mild && particle_steps > 1)
    advice = "one_pass"; // the body takes fewer steps
  else if (window.gain < 0.5 * window.unrelaxed_limit &&
           setup.step < setup.membrane_step)
    advice = "every_step";
  else if (is_mild)
    advice = "one_pass";
  std::printf("recommended      Coupling/exchange = %s\n", advice);
}

void print_step(const Test &test)
{
  const SetupStep *setup = test.setup_step();
  const dem::StepLimit &limit = test.step_limit();
  std::printf("time step        %.4g s, stable up to %.4g s (%s)\n",
              setup ? setup->step : test.time_step(), limit.step,
              limit.reason.c_str());
}

void check_test(const Case &parameters, const std::string &preparations)
{
  require_shareable(*dem::ranks_of_program(), parameters);
  const std::unique_ptr<Test> test = make_test(parameters);
  test->with_all_particles(
      [&](const dem::ParticleSystem &particles)
      {
        print_particles(particles);
        print_gradation(parameters, particles);
      });
  print_step(*test);
  if (const SetupStep *setup = test->setup_step(); setup && setup->gain)
    print_exchange(*setup, parameters.coupling.rules.particle_steps);
  test->describe();
  take_kept(find_store(preparations, test->preparation_text()), *test);
  omp_set_num_threads(thread_candidates(parameters.threads).back());
  const ScratchFolder scratch;
  Recorder recorder(parameters, run_folder_in(scratch));
  recorder.start(*test);
  const FastPreparation fast = test->fast_preparation();
  const MeanStep step =
      run_a_while(parameters, *test, recorder,
                  {test->duration(), test->period(), test->frame_interval(),
                   [&recorder] { return recorder.n_written(); }});
  print_predicted(test->duration(), step);
  if (!fast.is_packed)
    std::printf("too low          the specimen was still loose after the time "
                "for packing: --preparations DIR times one that is kept\n");
  if (fast.step > 0.)
    print_preparing(test->preparation_time(),
                    fast.cost ? *fast.cost
                              : time_particles(test->engine(), fast.step));
  test->describe_time(step);
  print_ranks(test->engine());
  print_memory(test->ranks());
}
} // namespace

int check_command(Words words)
{
  // Each line as soon as it is known, in a file or a pipe too.
  std::setvbuf(stdout, nullptr, _IOLBF, 0);
  std::string file, preparations;
  std::vector<Override> overrides;
  bool is_json = false;
  for (std::size_t k = 0; k < words.size(); ++k)
    if (words[k] == "--set" && k + 1 < words.size())
      overrides.push_back(parse_override(words[++k]));
    else if (words[k] == "--preparations" && k + 1 < words.size())
      preparations = words[++k];
    else if (words[k] == "--json")
      is_json = true;
    else if (words[k].starts_with("--") || !file.empty())
      throw InputError("check: " + words[k] +
                       ": must be one case file, --preparations DIR, --json "
                       "and --set Section/key=value");
    else
      file = words[k];
  if (file.empty())
    throw InputError("check: a case file must be given");
  const Case parameters = read_case(file, overrides);
  if (dem::ranks_of_program()->rank() == 0)
    report_deprecated(parameters.deprecated);
  else if (!std::freopen("/dev/null", "w", stdout)) // one speaks for all
    throw RunFailure("check: /dev/null cannot be opened");
  if (is_json)
  {
    std::fputs(parameter_json(parameters).c_str(), stdout);
    return 0;
  }
  std::printf("case             %s: %s\n", file.c_str(),
              parameters.title.c_str());
  for (const std::string &notice : parameters.notices)
    std::printf("note             %s\n", notice.c_str());
  check_test(parameters, preparations);
  return 0;
}
} // namespace spall
