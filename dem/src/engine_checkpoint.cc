#include "engine_state.h"
#include "parallel/scene_blocks.h"

#include <dem/binary.h>
#include <dem/contact/batch_stream.h>
#include <dem/shape/shape_stream.h>

#include <algorithm>
#include <sstream>
#include <utility>

namespace dem
{
namespace
{
constexpr std::int32_t is_sphere = -1, is_own = -2;

using Library = EngineState::Library;

void save_series(std::ostream &out, const ParticleShape &body,
                 const Library &library)
{
  std::int32_t index = is_sphere;
  if (body.series)
  {
    auto found = std::find(library.begin(), library.end(), body.series);
    if (found == library.end()) // a series of another rank may be a copy
      found = std::ranges::find_if(library, [&body](const auto &shared)
                                   { return *shared == *body.series; });
    index = found == library.end()
                ? is_own
                : static_cast<std::int32_t>(found - library.begin());
  }
  write_value(out, index);
  if (index == is_own)
    write_column(out, *body.series);
}

void restore_series(std::istream &in, ParticleShape &body,
                    const Library &library)
{
  std::int32_t index = is_sphere;
  read_value(in, index);
  body.series.reset();
  if (index == is_own)
  {
    Coefficients own;
    read_column(in, own);
    body.series = std::make_shared<const Coefficients>(std::move(own));
  }
  else if (index != is_sphere)
  {
    if (index < 0 || static_cast<std::size_t>(index) >= library.size())
      throw std::runtime_error("checkpoint names a shape that is not there");
    body.series = library[static_cast<std::size_t>(index)];
  }
}

/// What comes first in a state.
struct StateHeader
{
  StateExtent extent = StateExtent::rank;
  std::int32_t n_ranks = 1;  ///< that have parts, of extent `rank`
  std::int64_t n_blocks = 0; ///< of particles, of extent `scene`
};

/// Particles of a block: many of them, but few against a large scene.
std::int64_t block_size(std::int64_t n_particles)
{
  constexpr std::int64_t least_blocks = 16, most_particles = 16384;
  return std::clamp<std::int64_t>(n_particles / least_blocks, 1,
                                  most_particles);
}

/// Not by ignore(), which looks beyond the last byte: reading is collective.
void skip(std::istream &in, std::int64_t n_bytes)
{
  std::vector<char> piece(std::size_t{1} << 16);
  while (n_bytes > 0)
  {
    const auto now = std::min(n_bytes, static_cast<std::int64_t>(piece.size()));
    if (!in.read(piece.data(), now))
      throw std::runtime_error("checkpoint ends too early");
    n_bytes -= now;
  }
}

void require_fitting(const StateHeader &header, const Ranks &ranks)
{
  if (header.extent == StateExtent::rank && header.n_ranks != ranks.size())
    throw std::runtime_error(
        "state of one of " + std::to_string(header.n_ranks) +
        " ranks: cannot be continued on " + std::to_string(ranks.size()));
}
} // namespace

template <class Self, class Visit>
void EngineState::visit_state(Self &self, const Visit &visit)
{
  NeighborSchedule::visit(self.schedule, visit);
  visit(self.settings.particle.friction);
  visit(self.settings.local_damping);
  visit(self.settings.geometry.refresh_tolerance);
  visit(self.settings.breakage.is_active);
  visit(self.settings.breakage.repetitions);
  visit(self.steepest);
  visit(self.now);
  visit(self.path_at_sort);
  visit(self.released);
  visit(self.fractured);
  visit(self.step_count);
  visit(self.event_count);
  visit(self.refused_count);
  visit(self.grid);
  visit(self.grid_force);
  visit(self.recent_force);
  visit(self.lost);
  visit(self.overlap);
  visit(self.system.cell);
  visit(self.image_span);
  visit(self.least_radius);
  visit(self.largest_radius);
  visit(self.added_count);
  visit(self.system.has_shapes);
  visit(self.system.has_materials);
}

void EngineState::copy_values_to(EngineState &copy) const
{
  std::stringstream values;
  visit_state(*this,
              [&values](const auto &value) { write_value(values, value); });
  visit_state(copy, [&values](auto &value) { read_value(values, value); });
}

/// One state as its rows stand.
void EngineState::save_rows(std::ostream &out, const Library &library) const
{
  const auto put = [&out](const auto &column) { write_column(out, column); };
  ParticleSystem::visit(system, put);
  for (const ParticleShape &body : system.shape)
  {
    save_series(out, body, library);
    write_measures(out, body);
  }
  write_batch(out, pair_batch);
  write_value(out, walls.size());
  for (const auto &boundary : walls)
  {
    write_name(out, boundary->kind());
    boundary->pack(out);
  }
  put(work.damped);
  put(work.lifted);
  put(patches.factors);
  const auto put_value = [&out](const auto &value) { write_value(out, value); };
  visit_state(*this, put_value);
  ContactPointLists::visit(contact_points, put_value, put);
}

void EngineState::restore_rows(std::istream &in, const Library &library)
{
  const auto get = [&in](auto &column) { read_column(in, column); };
  system.n_ghosts = 0;
  ParticleSystem::visit(system, get);
  system.shape.resize(system.id.size());
  for (ParticleShape &body : system.shape)
  {
    restore_series(in, body, library);
    read_measures(in, body);
  }
  read_batch(in, pair_batch);
  std::size_t n_boundaries = 0;
  read_value(in, n_boundaries);
  walls.clear();
  for (std::size_t b = 0; b < n_boundaries; ++b)
  {
    walls.push_back(make_boundary(read_name(in)));
    walls.back()->unpack(in);
  }
  get(work.damped);
  get(work.lifted);
  get(patches.factors);
  const auto get_value = [&in](auto &value) { read_value(in, value); };
  visit_state(*this, get_value);
  ContactPointLists::visit(contact_points, get_value, get);
  system.follows_surfaces = settings.geometry.follows_surfaces();
}

/// All that belongs to the particles of this state, and how many bytes it is.
void EngineState::save_block(std::ostream &out, const Library &library)
{
  Leaving all;
  for (std::size_t i = 0; i < system.size(); ++i)
    all.add(static_cast<std::int32_t>(i));
  std::ostringstream block(std::ios::binary);
  write_parts(block, parts(), all);
  for (const ParticleShape &body : system.shape)
    save_series(block, body, library);
  write_value(out, static_cast<std::int64_t>(block.tellp()));
  out << block.view();
}

void EngineState::restore_block(std::istream &in, const Library &library)
{
  const std::size_t first = system.size();
  read_parts(in, parts());
  for (std::size_t i = first; i < system.size(); ++i)
    restore_series(in, system.shape[i], library);
}

/// Of all ranks, on the first one: the scene without particles, then these,
/// block by block.
void EngineState::save_scene(std::ostream &out, const Library &library)
{
  require_shareable();
  const bool is_first = distribution.ranks().rank() == 0;
  const std::int64_t size = block_size(added_count);
  const std::unique_ptr<EngineState> scene = scene_without_particles();
  if (is_first)
  {
    write_value(out, StateHeader{StateExtent::scene, 1,
                                 (added_count + size - 1) / size});
    scene->save_rows(out, library);
  }
  SceneBlocks blocks(distribution, parts());
  for (std::int64_t first = 0; first < added_count; first += size)
  {
    blocks.take(first, first + size, scene->parts());
    if (!is_first)
      continue;
    visit_batches(*scene,
                  [](ContactBatch &batch) { batch.clear_signs_of_zeros(); });
    std::ranges::fill(scene->pair_batch.target, 0); // restore() finds them
    scene->save_block(out, library);
    keep_particles(scene->parts(), {});
  }
  distribution.series().prune(); // the blocks have put all series there
}

/// In turn, the ranks take a block each.
void EngineState::restore_blocks(std::istream &in, const Library &library,
                                 std::int64_t n_blocks)
{
  const Ranks &ranks = distribution.ranks();
  for (std::int64_t block = 0; block < n_blocks; ++block)
  {
    std::int64_t n_bytes = 0;
    read_value(in, n_bytes);
    if (block % ranks.size() == ranks.rank())
      restore_block(in, library);
    else
      skip(in, n_bytes);
  }
}

void EngineState::save(std::ostream &out, const Library &library,
                       StateExtent extent)
{
  require_synchronized();
  admit_arrivals();
  if (extent == StateExtent::scene)
    return save_scene(out, library);
  write_value(out, StateHeader{extent, distribution.ranks().size(), 0});
  if (distribution.is_shared())
    own_part()->save_rows(out, library);
  else
    save_rows(out, library);
}

void EngineState::restore(std::istream &in, const Library &library)
{
  StateHeader header;
  read_value(in, header);
  require_fitting(header, distribution.ranks());
  pending_half_kick = 0.;
  restore_rows(in, library);
  events.clear();
  arrivals.clear();
  n_admitted = added_count;
  const bool is_shared = distribution.is_shared();
  if (header.extent == StateExtent::scene)
  {
    restore_blocks(in, library, header.n_blocks);
    if (is_shared)
      deal_out();
    else
      name_partners_by_row(parts());
  }
  system.renew_frames();
  pair_finder.forget();
  pair_loads.prepare(pair_batch);
  if (is_shared && schedule.n_made > 0)
    keep_partners();
}
} // namespace dem
