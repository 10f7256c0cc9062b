#include "case_file.h"
#include "check_parts.h"
#include "commands.h"
#include "errors.h"
#include "lab_test.h"
#include "triaxial.h"

#include <dem/integrate/contact_springs.h>

#include <chrono>
#include <cmath>
#include <cstdio>

namespace spall
{
namespace
{
/// Wall-clock of one step of the stones when they are packed [s]: the cloud is
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
  for (const auto &[lower, upper] : specimen.box)
    engine.planes()[upper].point *= shrink;
  constexpr double frozen = 1e-15; // [s]: nothing moves
  engine.advance(frozen);
  constexpr int n_steps = 200;
  const auto start = std::chrono::steady_clock::now();
  for (int step = 0; step < n_steps; ++step)
    engine.advance(frozen);
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start)
             .count() /
         n_steps;
}

/// Wall-clock of one step of the membrane alone [s].
double membrane_step_cost(const Case &parameters)
{
  const int n = parameters.boundary.elements_per_side;
  fem::Membrane membrane(
      parameters.membrane,
      fem::box_sides(dem::Vec3::Zero(),
                     dem::Vec3::Constant(parameters.specimen.side), {n, n, n}));
  const std::vector<Eigen::Vector3d> load(membrane.n_nodes(),
                                          Eigen::Vector3d::Zero());
  constexpr int n_steps = 200;
  const auto start = std::chrono::steady_clock::now();
  for (int step = 0; step < n_steps; ++step)
  {
    membrane.begin_step(1e-15);
    membrane.end_step(load, 1e-15);
  }
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start)
             .count() /
         n_steps;
}

void print_step(const Triaxial &test)
{
  const dem::StepLimit limit =
      dem::critical_step(test.engine().parameters(), test.engine().particles());
  std::printf("time step        %.4g s, stable up to %.4g s (%s)\n",
              test.time_step(), limit.step, limit.reason.c_str());
  std::printf(
      "in a corner      %.4g s (the same stone on three walls)\n",
      dem::corner_step(test.engine().parameters(), test.engine().particles()));
  if (test.gain())
    print_exchange(test.setup_step(), "membrane");
}

void print_cost(const Case &parameters, const Triaxial &test)
{
  double cost = packed_step_cost(parameters);
  if (test.gain())
    cost += membrane_step_cost(parameters);
  const double steps = (test.period() * parameters.loading.n_cycles() +
                        parameters.loading.consolidation_time) /
                       test.time_step();
  print_memory();
  std::printf("predicted time   %.3g s for %.4g steps after the preparation "
              "(%.3g ms each)\n",
              cost * steps, steps, 1e3 * cost);
}

void check_triaxial(const Case &parameters)
{
  const Triaxial test(parameters);
  print_stones(test.engine());
  print_step(test);
  print_cost(parameters, test);
}

/// The first steps are run to see how fast simulated time goes by.
void check_lab(const Case &parameters)
{
  const std::unique_ptr<LabTest> test = make_lab_test(parameters);
  print_stones(test->engine());
  const dem::StepLimit limit = dem::critical_step(test->engine().parameters(),
                                                  test->engine().particles());
  std::printf("time step        %.4g s, at most %.4g s (%s)\n",
              test->time_step(), limit.step, limit.reason.c_str());
  using Clock = std::chrono::steady_clock;
  const auto start = Clock::now();
  constexpr int n_steps = 20000;
  for (int step = 0; step < n_steps && test->share_done() < 1.; ++step)
    test->advance();
  const double spent =
      std::chrono::duration<double>(Clock::now() - start).count();
  print_memory();
  std::printf(
      "predicted time   %.3g s for %.4g s of the test (the first %.3g s "
      "took %.3g s)\n",
      spent * test->duration() / test->engine().time(), test->duration(),
      test->engine().time(), spent);
}
} // namespace

int check_command(Words words)
{
  std::string file;
  std::vector<Override> overrides;
  for (std::size_t k = 0; k < words.size(); ++k)
    if (words[k] == "--set" && k + 1 < words.size())
      overrides.push_back(parse_override(words[++k]));
    else if (words[k].starts_with("--") || !file.empty())
      throw InputError("check: " + words[k] +
                       ": must be one case file and --set "
                       "Section/key=value");
    else
      file = words[k];
  if (file.empty())
    throw InputError("check: a case file must be given");
  const Case parameters = read_case(file, overrides);
  std::printf("case             %s: %s\n", file.c_str(),
              parameters.title.c_str());
  if (parameters.kind == CaseKind::dynamic_triaxial)
    check_triaxial(parameters);
  else if (parameters.kind == CaseKind::subgrade)
    check_subgrade_cost(parameters);
  else
    check_lab(parameters);
  return 0;
}
} // namespace spall
