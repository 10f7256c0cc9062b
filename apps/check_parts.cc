#include "check_parts.h"

#include <algorithm>
#include <cstdio>
#include <fstream>

namespace spall
{
namespace
{
/// Resident memory of the program [MiB].
double memory_in_use()
{
  std::ifstream status("/proc/self/statm");
  double pages = 0., resident = 0.;
  status >> pages >> resident;
  return resident * 4096. / (1024. * 1024.);
}

} // namespace

void print_memory()
{
  std::printf("memory           %.0f MiB\n", memory_in_use());
}

void print_stones(const dem::Engine &engine)
{
  const dem::Particles &stones = engine.particles();
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

void print_exchange(const SetupStep &setup, const char *body)
{
  const coupling::ExchangeGain &gain = *setup.gain;
  const coupling::WindowGain &window = setup.window;
  std::printf("exchange gain    %.4g, stable below %.4g\n", gain.gain,
              gain.limit);
  std::printf("of a window      %.4g: one_pass below %.4g, iterated without "
              "relaxation below %.4g, best constant relaxation %.3g\n",
              window.gain, window.one_pass_limit, window.unrelaxed_limit,
              window.best_relaxation);
  std::printf("%-9salone   explicit steps of at most %.4g s\n", body,
              setup.membrane_step);
  const char *advice = "iterated with aitken";
  if (window.gain < 0.5 * window.unrelaxed_limit &&
      setup.step < setup.membrane_step)
    advice = "every_step";
  else if (window.gain < 0.5 * window.one_pass_limit)
    advice = "one_pass";
  std::printf("recommended      Coupling/exchange = %s\n", advice);
}
} // namespace spall
