#include "bench/measure.h"

#include <chrono>
#include <ctime>
#include <fstream>
#include <limits>
#include <string>

namespace spall
{
namespace
{
double cpu_seconds()
{
  return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}
} // namespace

BenchSample measure(dem::Engine &engine, int n_steps, double time_step)
{
  using Clock = std::chrono::steady_clock;
  BenchSample sample;
  sample.n_steps = n_steps;
  sample.before = count_contacts(engine);
  sample.energy_before = engine.energy();
  const dem::EngineClock then = engine.clock();
  const std::int64_t rebuilds = engine.n_rebuilds(), events = engine.n_events();
  const double cpu = cpu_seconds();
  const auto start = Clock::now();
  for (int step = 0; step < n_steps; ++step)
    engine.advance(time_step);
  sample.wall = std::chrono::duration<double>(Clock::now() - start).count();
  sample.cpu = cpu_seconds() - cpu;
  const dem::EngineClock now = engine.clock();
  sample.phases = {now.contacts - then.contacts, now.search - then.search,
                   now.breakage - then.breakage, now.motion - then.motion};
  sample.n_rebuilds = engine.n_rebuilds() - rebuilds;
  sample.n_events = engine.n_events() - events;
  sample.after = count_contacts(engine);
  sample.energy_after = engine.energy();
  sample.checksum = position_checksum(engine);
  return sample;
}

double energy_residual(const dem::EngineEnergy &e)
{
  return e.plane_work + e.surface_work + e.gravity_work - e.kinetic -
         e.elastic - e.friction - e.rolling - e.damping - e.breakage -
         e.shape_work;
}

MemoryUse memory_use()
{
  MemoryUse use;
  std::ifstream status("/proc/self/status");
  for (std::string key; status >> key;)
  {
    if (key == "VmRSS:" && status >> use.now)
      use.now *= 1024.;
    else if (key == "VmHWM:" && status >> use.peak)
      use.peak *= 1024.;
    status.ignore(std::numeric_limits<std::streamsize>::max(), '\n');
  }
  return use;
}
} // namespace spall
