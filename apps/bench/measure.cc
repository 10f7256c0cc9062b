#include "bench/measure.h"

#include "run/cost.h"

#include <dem/parallel/distribution.h>

#include <array>
#include <chrono>
#include <cmath>

namespace spall
{
BenchSample measure(dem::Engine &engine, int n_steps, double time_step)
{
  using Clock = std::chrono::steady_clock;
  BenchSample sample;
  sample.n_steps = n_steps;
  sample.before = count_contacts(engine);
  sample.energy_before = engine.energy();
  const dem::EngineClock then = engine.clock();
  const std::int64_t rebuilds = engine.n_rebuilds(), events = engine.n_events();
  const double cpu = processor_seconds();
  const auto start = Clock::now();
  for (int step = 0; step < n_steps; ++step)
    engine.advance_deferred(time_step);
  // The slowest rank decides, and all of them cost.
  const dem::Ranks &ranks = engine.distribution().ranks();
  std::array wall{std::chrono::duration<double>(Clock::now() - start).count()};
  ranks.max(wall);
  std::array microseconds{
      std::int64_t(std::llround(1e6 * (processor_seconds() - cpu)))};
  ranks.sum(microseconds);
  sample.wall = wall[0];
  sample.cpu = 1e-6 * static_cast<double>(microseconds[0]);
  const dem::EngineClock now = engine.clock();
  sample.phases = {now.contacts - then.contacts, now.search - then.search,
                   now.breakage - then.breakage, now.motion - then.motion,
                   now.exchange - then.exchange};
  sample.n_rebuilds = engine.n_rebuilds() - rebuilds;
  sample.n_events = engine.n_events() - events;
  engine.synchronize();
  sample.after = count_contacts(engine);
  sample.energy_after = engine.energy();
  sample.share = rank_share(engine);
  sample.checksum = position_checksum(engine);
  return sample;
}

double energy_residual(const dem::EngineEnergy &e)
{
  return e.work_of("planes") + e.work_of("facets") + e.gravity_work -
         e.kinetic - e.elastic - e.friction - e.rolling - e.damping -
         e.breakage - e.non_conservative_work;
}
} // namespace spall
