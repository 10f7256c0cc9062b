// The scene of all ranks on the first of them, and back.
#include "engine_state.h"
#include "parallel/scene_blocks.h"

#include <dem/parallel/rank_sums.h>

#include <algorithm>
#include <array>
#include <numeric>
#include <stdexcept>

namespace dem
{
namespace
{
void forget_particles(Boundary &boundary, std::size_t n_particles)
{
  boundary.keep_contacts({});
  boundary.keep_particles(std::vector<std::int32_t>(n_particles, -1));
  if (std::vector<CandidatePair> *candidates = boundary.candidates())
    candidates->clear();
}

std::vector<std::int32_t> order_of(const std::vector<std::int64_t> &ids)
{
  std::vector<std::int32_t> order(ids.size());
  std::iota(order.begin(), order.end(), 0);
  std::ranges::sort(order, {},
                    [&ids](std::int32_t row)
                    { return ids[static_cast<std::size_t>(row)]; });
  return order;
}

LostEnergy sum_over_ranks(const Ranks &ranks, const LostEnergy &own)
{
  std::array sums{own.friction, own.rolling, own.damping,
                  own.non_conservative_work};
  dem::sum_over_ranks(ranks, sums);
  return {sums[0], sums[1], sums[2], sums[3]};
}
} // namespace

/// All but the particles, their contacts and what else belongs to them; the
/// boundaries with all that they have.
std::unique_ptr<EngineState> EngineState::copy_of_values() const
{
  auto copy = std::make_unique<EngineState>(settings, one_rank());
  copy_values_to(*copy);
  copy->keeps_inside = keeps_inside;
  copy->spent = spent;
  copy->system.follows_surfaces = system.follows_surfaces;
  for (const auto &boundary : walls)
    copy->walls.push_back(boundary->copy());
  copy->contact_points = contact_points;
  copy->patches = patches;
  return copy;
}

/// Values of all ranks, and boundaries without contacts.
std::unique_ptr<EngineState> EngineState::scene_without_particles()
{
  std::unique_ptr<EngineState> scene = copy_of_values();
  scene->path_at_sort = 0.; // in the order of the ids
  scene->pair_batch = pair_batch.select({});
  scene->contact_points.candidates().clear();
  std::ranges::for_each(scene->walls, [this](const auto &boundary)
                        { forget_particles(*boundary, system.size()); });
  const Ranks &ranks = distribution.ranks();
  scene->lost = sum_over_ranks(ranks, lost);
  for (std::size_t k = 0; k < walls.size(); ++k)
  {
    std::array friction{walls[k]->friction};
    dem::sum_over_ranks(ranks, friction);
    scene->walls[k]->friction = friction[0];
  }
  scene->overlap = largest_over_ranks(ranks, overlap);
  scene->contact_points.events =
      dem::sum_over_ranks(ranks, contact_points.events);
  std::array largest{recent_force, schedule.displaced() ? 1. : 0.,
                     schedule.displaced_on_deforming() ? 1. : 0.};
  ranks.max(largest);
  scene->recent_force = largest[0];
  if (largest[1] > 0.)
    scene->schedule.note_displaced();
  if (largest[2] > 0.)
    scene->schedule.note_displaced_on_deforming();
  return scene;
}

std::unique_ptr<EngineState> EngineState::gathered()
{
  require_synchronized();
  admit_arrivals();
  std::unique_ptr<EngineState> whole;
  if (distribution.is_shared())
  {
    whole = scene_without_particles();
    SceneBlocks(distribution, parts()).take(0, added_count, whole->parts());
    name_partners_by_row(whole->parts());
  }
  else
  {
    whole = copy_of_values();
    whole->system = system;
    whole->work = work;
    whole->pair_batch = pair_batch;
  }
  whole->order_by_id();
  return whole;
}

/// As it stands on this rank, without ghosts and with partners named by id.
std::unique_ptr<EngineState> EngineState::own_part() const
{
  std::unique_ptr<EngineState> part = copy_of_values();
  part->system = system;
  part->work = work;
  part->pair_batch = pair_batch;
  name_partners_by_id(part->parts());
  drop_ghosts(part->system);
  return part;
}

/// The order of rows and contacts is that of the ids, whatever it was: sums
/// over a scene are the same on any number of ranks.
void EngineState::order_by_id()
{
  if (distribution.is_shared())
    throw std::logic_error("engine: on many ranks gathered() has an order");
  put_in_order(order_of(system.id));
  path_at_sort = 0.; // in another order
  for (const auto &boundary : walls)
    if (boundary->can_be_shared())
      boundary->sort_contacts();
  visit_batches(*this,
                [](ContactBatch &batch) { batch.clear_signs_of_zeros(); });
  pair_loads.prepare(pair_batch);
}

/// Particles that have been read go to their owners. What is summed over the
/// ranks, the first one alone has.
void EngineState::deal_out()
{
  require_shareable();
  if (distribution.ranks().rank() != 0)
  {
    lost = {};
    contact_points.events = {};
    for (const auto &boundary : walls)
      boundary->friction = {};
  }
  distribution.deal_out(parts());
}

/// Ghosts are the partners of the pairs and candidates that are listed, which
/// stay as they are.
void EngineState::keep_partners()
{
  constexpr double reserve = 2.; // they may have moved apart since the search
  const bool reads_shape =
      follows_pairs() || traits(pair_geometry()).reads_shape;
  const double range =
      follows_pairs()
          ? ContactPointLists::search_range(system, contact_point_skin())
          : PairFinder::search_range(system, pair_skin());
  distribution.add_ghosts(parts(), reserve * range, reads_shape);
  std::vector<std::uint8_t> is_named = contact_points.named(system.size());
  for (std::size_t k = 0; k < pair_batch.size(); ++k)
    is_named.at(static_cast<std::size_t>(pair_batch.b[k])) = 1;
  distribution.keep_ghosts(parts(), is_named);
  pair_finder.forget();
  pair_loads.prepare(pair_batch);
}
} // namespace dem
