#include "case/file.h"
#include "commands/commands.h"
#include "errors.h"
#include "laboratory/test.h"
#include "run/cost.h"
#include "run/forecast.h"
#include "run/preparation_store.h"
#include "triaxial/preparation.h"
#include "triaxial/triaxial.h"

#include <dem/integrate/contact_springs.h>

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <optional>

namespace spall
{
namespace
{
/// Steps of a test that goes on from its preparation, if that is kept in the
/// store [s]; says so.
template <class Test>
std::optional<MeanStep>
steps_from_store(const std::optional<PreparationStore> &store, int threads,
                 Test &test, const std::function<bool()> &advance)
{
  std::string said;
  if (!store)
    return {};
  if (store->take([&test](std::istream &in) { test.take_prepared(in); }, said))
  {
    std::printf("preparation      %s\n", store->path().c_str());
    return time_steps(test.engine(), threads, advance);
  }
  std::printf("preparation      %s\n",
              said.empty() ? "none of this kept" : said.c_str());
  return {};
}

/// Where `--preparations` says, if there is such a folder.
std::optional<PreparationStore> find_store(const std::string &folder,
                                           const std::string &text)
{
  if (folder.empty() || text.empty() || !std::filesystem::is_directory(folder))
    return {};
  return PreparationStore(folder, text);
}

/// Cost of one step of the stones when they are packed [s]: the cloud is
/// drawn together to the expected solid fraction and evaluated in place.
double packed_step_cost(const Case &parameters)
{
  Case quiet = parameters;
  quiet.breakage.is_active = false;
  Specimen specimen = make_specimen(quiet);
  dem::Engine &engine = *specimen.engine;
  const double shrink = std::cbrt(parameters.specimen.initial_solid_fraction /
                                  parameters.specimen.solid_fraction);
  for (dem::StoneState &stone : engine.particles().state)
    stone.position *= shrink;
  for (dem::Plane &plane : engine.planes())
    plane.point *= shrink;
  if (dem::Drum side = engine.drum(); side.is_there())
  {
    side.centre *= shrink;
    side.radius *= shrink;
    engine.set_drum(side);
  }
  return still_step_cost(engine, parameters.threads);
}

/// Cost of one step of the membrane alone [s].
double membrane_step_cost(const Case &parameters)
{
  fem::Membrane membrane(parameters.membrane,
                         lateral_mesh(parameters, dem::Vec3::Zero(),
                                      nominal_size(parameters.specimen)));
  return still_step_cost(membrane);
}

/// That the membrane takes for a step of the stones; a pass over a window
/// predicts and corrects.
double membrane_steps(const Case &parameters)
{
  const CouplingParameters &c = parameters.coupling;
  const double passes = c.exchange == ExchangeChoice::every_step ? 1. : 2.;
  return passes * c.body_steps / c.rules.stone_steps;
}

void print_memory()
{
  std::printf("memory           %.0f MiB\n",
              memory_use().now / (1024. * 1024.));
}

void print_stones(const dem::Particles &stones)
{
  double smallest = stones.radius(0), largest = smallest, mass = 0.;
  std::size_t n_breakable = 0;
  for (std::size_t i = 0; i < stones.size(); ++i)
  {
    smallest = std::min(smallest, stones.radius(i));
    largest = std::max(largest, stones.radius(i));
    mass += stones.mass(i);
    n_breakable += stones.is_breakable[i];
  }
  std::printf("stones           %zu, %zu breakable, diameter %.4g to %.4g m, "
              "%.4g kg\n",
              stones.size(), n_breakable, 2. * smallest, 2. * largest, mass);
}

/// The gain that counts, what the ways of exchange stand, and which to take.
void print_exchange(const SetupStep &setup, int stone_steps)
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
  if (is_mild && stone_steps > 1)
    advice = "one_pass"; // the body takes fewer steps
  else if (window.gain < 0.5 * window.unrelaxed_limit &&
           setup.step < setup.membrane_step)
    advice = "every_step";
  else if (is_mild)
    advice = "one_pass";
  std::printf("recommended      Coupling/exchange = %s\n", advice);
}

void print_step(const Case &parameters, const Triaxial &test)
{
  const dem::StepLimit limit =
      dem::critical_step(test.engine().parameters(), test.engine().particles());
  std::printf("time step        %.4g s, stable up to %.4g s (%s)\n",
              test.setup_step().step, limit.step, limit.reason.c_str());
  std::printf(
      "in a corner      %.4g s (the same stone on three walls)\n",
      dem::corner_step(test.engine().parameters(), test.engine().particles()));
  if (test.gain())
    print_exchange(test.setup_step(), parameters.coupling.rules.stone_steps);
}

/// A step by the lists of stones and membrane as they are packed.
MeanStep still_step(const Case &parameters, const Triaxial &test)
{
  double cost = packed_step_cost(parameters);
  if (test.gain())
    cost += membrane_step_cost(parameters) * membrane_steps(parameters);
  return {test.setup_step().step, cost};
}

void print_cost(const Case &parameters, Triaxial &test,
                const std::string &preparations)
{
  const double duration = test.period() * parameters.loading.n_cycles() +
                          parameters.loading.consolidation_time;
  const auto store =
      find_store(preparations, preparation_text(parameters, test.shapes()));
  const auto advance = [&test]
  {
    test.advance();
    return test.stage() != Stage::done;
  };
  const std::optional<MeanStep> seen =
      steps_from_store(store, parameters.threads, test, advance);
  print_memory();
  print_predicted(duration, seen ? *seen : still_step(parameters, test));
  if (parameters.cycle_jump.is_on())
    std::printf("                 less what CycleJump skips\n");
}

void check_triaxial(const Case &parameters, const std::string &preparations)
{
  Triaxial test(parameters);
  print_stones(test.engine().particles());
  print_step(parameters, test);
  print_cost(parameters, test, preparations);
}

void check_lab(const Case &parameters, const std::string &preparations)
{
  const std::unique_ptr<LabTest> test = make_lab_test(parameters);
  print_stones(test->all_stones());
  std::printf("time step        %.4g s, at most %.4g s (%s)\n",
              test->time_step(), test->step_limit().step,
              test->step_limit().reason.c_str());
  if (const SetupStep *setup = test->setup_step(); setup && setup->gain)
    print_exchange(*setup, parameters.coupling.rules.stone_steps);
  const auto store = find_store(preparations, test->preparation_text());
  const auto advance = [&test]
  {
    test->advance();
    return test->share_done() < 1.;
  };
  if (auto seen = steps_from_store(store, parameters.threads, *test, advance))
  {
    seen->cost += test->unseen_cost();
    print_predicted(test->duration(), *seen);
  }
  else
    test->print_forecast();
  print_memory();
}
} // namespace

int check_command(Words words)
{
  std::string file, preparations;
  std::vector<Override> overrides;
  for (std::size_t k = 0; k < words.size(); ++k)
    if (words[k] == "--set" && k + 1 < words.size())
      overrides.push_back(parse_override(words[++k]));
    else if (words[k] == "--preparations" && k + 1 < words.size())
      preparations = words[++k];
    else if (words[k].starts_with("--") || !file.empty())
      throw InputError("check: " + words[k] +
                       ": must be one case file, --preparations DIR and --set "
                       "Section/key=value");
    else
      file = words[k];
  if (file.empty())
    throw InputError("check: a case file must be given");
  const Case parameters = read_case(file, overrides);
  std::printf("case             %s: %s\n", file.c_str(),
              parameters.title.c_str());
  if (parameters.kind == CaseKind::dynamic_triaxial)
    check_triaxial(parameters, preparations);
  else
    check_lab(parameters, preparations);
  return 0;
}
} // namespace spall
