// What the engine does where its particles are spread over ranks.
#include "engine_state.h"
#include "phase_timer.h"

#include <dem/parallel/faults.h>
#include <dem/parallel/rank_sums.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <stdexcept>

namespace dem
{
std::string EngineState::obstacle_to_sharing() const
{
  if (settings.breakage.is_active &&
      settings.breakage.memory == FactorMemory::patch)
    return "breakage with factors that patches keep";
  if (system.cell.is_there())
    return "a periodic cell";
  for (const auto &boundary : walls)
    if (!boundary->can_be_shared())
      return "boundaries of kind " + boundary->kind();
  return {};
}

/// Throws std::invalid_argument where the scene needs what is not spread over
/// ranks.
void EngineState::require_shareable() const
{
  if (const std::string what = obstacle_to_sharing(); !what.empty())
    throw std::invalid_argument(what +
                                " cannot be spread over ranks: use one rank");
}

/// Fastest particles of all ranks.
Speeds EngineState::over_ranks(const Speeds &own)
{
  if (!distribution.is_shared())
    return own;
  const PhaseTimer timer(spent.exchange);
  std::array largest{own.moving, own.closing, own.is_finite ? 0. : 1.,
                     schedule.displaced() ? 1. : 0.,
                     schedule.displaced_on_deforming() ? 1. : 0.};
  // A maximum may pass over what is no number.
  for (double &value : largest)
    value = std::isfinite(value) ? value : 0.;
  distribution.ranks().max(largest);
  if (largest[3] > 0.)
    schedule.note_displaced();
  if (largest[4] > 0.)
    schedule.note_displaced_on_deforming();
  return {largest[0], largest[1], largest[2] == 0.};
}

/// Particles go to the ranks that own them, and candidates of pairs are
/// searched, with the ghosts that they need.
void EngineState::redistribute()
{
  require_shareable();
  ++redistribution_count;
  distribution.migrate(parts(),
                       partition_interval > 0 &&
                           redistribution_count % partition_interval == 0);
  if (follows_pairs())
    search_contact_points();
  else
    search_pairs();
}

/// Particles that were added since the last step go to their owners. Nothing is
/// searched: that is done when the lists are made, as on one rank.
void EngineState::admit_arrivals()
{
  if (!distribution.is_shared() || n_admitted == added_count)
    return;
  n_admitted = added_count;
  if (schedule.n_made == 0) // they were dealt out
    return;
  require_shareable();
  distribution.migrate(parts(), false,
                       [this]
                       {
                         for (const NewParticle &particle : arrivals)
                           append(particle);
                         arrivals.clear();
                       });
  keep_partners();
}

DistributedParts EngineState::parts()
{
  return {system, work, pair_batch, contact_points.candidates(), walls};
}

void EngineState::search_pairs()
{
  const double skin = pair_skin();
  distribution.add_ghosts(parts(), PairFinder::search_range(system, skin),
                          traits(pair_geometry()).reads_shape);
  pair_finder.forget(); // rows are others now
  pair_finder.search(system, pair_geometry(), skin, schedule.paths);
  pair_finder.renumber(
      distribution.keep_ghosts(parts(), pair_finder.named(system.size())));
}

void EngineState::search_contact_points()
{
  const double skin = contact_point_skin();
  distribution.add_ghosts(parts(),
                          ContactPointLists::search_range(system, skin), true);
  contact_points.search(system, skin, schedule.paths);
  // Their partners are renumbered with those of the contacts.
  distribution.keep_ghosts(parts(), contact_points.named(system.size()));
}

/// Ghosts get the states of their particles: lists may be rebuilt from them.
void EngineState::send_states()
{
  if (!distribution.is_shared() || schedule.n_made == 0)
    return;
  const PhaseTimer timer(spent.exchange);
  distribution.send_states(system);
}

/// Loads of boundaries become sums over all ranks; a fault of one rank stops
/// all, and all take part where one asks for breakage or has large forces.
void EngineState::share_loads()
{
  const PhaseTimer timer(spent.exchange);
  std::vector<ExactSum> sums(3);
  sums[0].add(fault.empty() ? 0. : 1.);
  sums[1].add(wants_breakage ? 1. : 0.);
  sums[2].add(has_large_forces ? 1. : 0.);
  std::vector<std::int64_t> counts;
  std::vector<BoundarySums> of_boundaries;
  for (const auto &boundary : walls)
  {
    const BoundarySums own = boundary->sum_loads(grid);
    sums.insert(sums.end(), own.exact.begin(), own.exact.end());
    counts.insert(counts.end(), own.counts.begin(), own.counts.end());
    of_boundaries.push_back(own);
  }
  sum_over_ranks(distribution.ranks(), sums, counts);
  if (sums[0].value() > 0.)
    stop_together<OverlapStop>(distribution.ranks(), fault);
  wants_breakage = sums[1].value() > 0.;
  has_large_forces = sums[2].value() > 0.;
  auto next_sum = sums.begin() + 3;
  auto next_count = counts.begin();
  for (const BoundarySums &own : of_boundaries)
  {
    for (ExactSum &sum : own.exact)
      sum = *next_sum++;
    for (std::int64_t &count : own.counts)
      count = *next_count++;
  }
}
} // namespace dem
