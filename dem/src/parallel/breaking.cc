#include "../row_of.h"
#include "parcel_stream.h"
#include "particle_stream.h"

#include <dem/binary.h>
#include <dem/parallel/breaking.h>

#include <algorithm>
#include <numeric>
#include <set>
#include <unordered_map>

namespace dem
{
namespace
{
using Rows = std::vector<std::int32_t>;

/// What every rank has written, by rank.
std::vector<Parcel> gather(const Ranks &ranks, const std::ostringstream &own)
{
  const Parcel parcel = parcel_for(ranks.rank(), own);
  std::vector<Parcel> all;
  for (std::vector<std::byte> &content : ranks.gather(parcel.content))
    all.push_back({static_cast<int>(all.size()), std::move(content)});
  return all;
}

/// Ids of the particles that some contact of any rank asks to break.
std::set<std::int64_t> asked_to_break(const Ranks &ranks,
                                      const DistributedParts &parts)
{
  std::vector<std::int64_t> own;
  const auto add = [&](const ContactBatch &batch)
  {
    for (std::size_t k = 0; batch.layout.has_damage && k < batch.size(); ++k)
    {
      if (batch.event[k] & 1u)
        own.push_back(parts.particles.id[row_of(batch.a[k])]);
      if (batch.event[k] & 2u)
        own.push_back(parts.particles.id[row_of(batch.b[k])]);
    }
  };
  add(parts.pairs);
  for (const auto &boundary : parts.boundaries)
    add(boundary->batch);
  std::ostringstream out;
  write_column(out, own);
  std::set<std::int64_t> all;
  for (const Parcel &parcel : gather(ranks, out))
  {
    ParcelReader in(parcel);
    std::vector<std::int64_t> ids;
    read_column(in.stream, ids);
    all.insert(ids.begin(), ids.end());
  }
  return all;
}

/// Copies of some contacts of all ranks, sorted, and where they come from: of
/// pairs, or with a boundary.
struct CopiedContacts
{
  std::unique_ptr<Boundary> on; ///< has those with a boundary
  ContactBatch of_pairs;
  Rows own_rows;              ///< of the batch of this rank
  std::int32_t first_own = 0; ///< of them, as gathered
  Rows order;                 ///< gathered number of each copy

  ContactBatch &copies() { return on ? on->batch : of_pairs; }

  /// Contacts that have one of the particles as a side, named by id.
  /// `boundary`: null, of pairs. Collective.
  CopiedContacts(const Ranks &ranks, const ParticleSystem &particles,
                 const ContactBatch &batch, const Boundary *boundary,
                 const std::set<std::int64_t> &of_particles)
      : on(boundary ? make_boundary(boundary->kind()) : nullptr)
  {
    const auto id = [&particles](std::int32_t row)
    { return particles.id[row_of(row)]; };
    for (std::size_t k = 0; k < batch.size(); ++k)
      if (of_particles.contains(id(batch.a[k])) ||
          (batch.layout.has_partners && of_particles.contains(id(batch.b[k]))))
        own_rows.push_back(static_cast<std::int32_t>(k));
    ContactBatch own = batch.select(own_rows);
    for (std::size_t k = 0; k < own.size(); ++k)
    {
      own.a[k] = static_cast<std::int32_t>(id(own.a[k]));
      if (own.layout.has_partners)
        own.b[k] = static_cast<std::int32_t>(id(own.b[k]));
    }
    std::ostringstream out;
    write_batch(out, own);
    if (boundary)
      boundary->pack_contacts(out, own_rows);
    copies() = batch.select({});
    for (const Parcel &parcel : gather(ranks, out))
    {
      ParcelReader in(parcel);
      ContactBatch more;
      read_batch(in.stream, more);
      if (parcel.rank == ranks.rank())
        first_own = static_cast<std::int32_t>(copies().size());
      copies().append(more);
      if (boundary)
        on->unpack_contacts(in.stream);
    }
  }

  /// Sides are named by row from here on; `row_of_id` keeps the order of ids.
  void
  name_by_row(const std::unordered_map<std::int64_t, std::int32_t> &row_of_id)
  {
    ContactBatch &batch = copies();
    for (std::size_t k = 0; k < batch.size(); ++k)
    {
      batch.a[k] = row_of_id.at(batch.a[k]);
      if (batch.layout.has_partners)
        batch.b[k] = row_of_id.at(batch.b[k]);
    }
    if (on)
    {
      order = on->sort_contacts();
      return;
    }
    order = batch.by_pair();
    batch = batch.select(order);
  }

  /// Calls call(own row, copy) for those that this rank has.
  template <class Call>
  void for_own(const Call &call) const
  {
    const auto n_own = static_cast<std::int32_t>(own_rows.size());
    for (std::size_t k = 0; k < order.size(); ++k)
      if (const std::int32_t own = order[k] - first_own;
          own >= 0 && own < n_own)
        call(row_of(own_rows[row_of(own)]), k);
  }
};

/// Own pairs take over what their copies have become.
void put_back(const CopiedContacts &pairs, ContactBatch &batch)
{
  pairs.for_own(
      [&](std::size_t row, std::size_t k)
      {
        ContactBatch one = pairs.of_pairs.extract(k);
        one.a[0] = batch.a[row];
        one.b[0] = batch.b[row];
        one.target[0] = batch.target[row];
        batch.replace(row, one);
      });
}

/// Copies of particles of all ranks, in the order of their ids. Collective.
ParticleSystem copied_particles(Distribution &distribution,
                                const ParticleSystem &particles,
                                const std::set<std::int64_t> &ids)
{
  Rows rows;
  for (std::size_t i = 0; i < particles.n_owned(); ++i)
    if (ids.contains(particles.id[i]))
      rows.push_back(static_cast<std::int32_t>(i));
  std::ostringstream out;
  write_particles(out, particles, rows);
  write_column(out, series_keys(particles, rows, distribution.series()));
  ParticleSystem copies;
  copies.has_shapes = particles.has_shapes;
  copies.has_materials = particles.has_materials;
  copies.follows_surfaces = particles.follows_surfaces;
  std::vector<std::pair<int, SeriesKey>> wanted;
  for (const Parcel &parcel : gather(distribution.ranks(), out))
  {
    ParcelReader in(parcel);
    read_particles(in.stream, copies);
    std::vector<SeriesKey> keys;
    read_column(in.stream, keys);
    for (const SeriesKey &key : keys)
      wanted.emplace_back(parcel.rank, key);
  }
  fetch_series(distribution.ranks(), distribution.series(), wanted, 0, copies);
  Rows order(copies.size());
  std::iota(order.begin(), order.end(), 0);
  std::ranges::sort(order, {},
                    [&copies](std::int32_t row)
                    { return copies.id[row_of(row)]; });
  copies.reorder(order);
  return copies;
}

std::unordered_map<std::int64_t, std::int32_t>
rows_by_id(const ParticleSystem &particles)
{
  std::unordered_map<std::int64_t, std::int32_t> row;
  for (std::size_t i = 0; i < particles.size(); ++i)
    row[particles.id[i]] = static_cast<std::int32_t>(i);
  return row;
}

/// Particles of this rank, ghosts included, that have broken take over their
/// new shapes.
void put_back(const ParticleSystem &copies,
              std::span<const BreakageEvent> events, double density,
              ParticleSystem &particles)
{
  std::set<std::int64_t> broken;
  for (const BreakageEvent &event : events)
    broken.insert(event.particle);
  const auto row = rows_by_id(copies);
  for (std::size_t i = 0; i < particles.size(); ++i)
  {
    if (!broken.contains(particles.id[i]))
      continue;
    const std::size_t copy = row_of(row.at(particles.id[i]));
    particles.shape[i] = copies.shape[copy];
    particles.is_breakable[i] = copies.is_breakable[copy];
    particles.path_length[i] = copies.path_length[copy];
    particles.update_mass(i, density);
  }
}

ForceContext with(ParticleSystem &copies, const ForceContext &context)
{
  ForceContext of_copies{context.parameters, context.elasticity, copies,
                         context.time_step};
  of_copies.path_length = context.path_length;
  of_copies.step_path = context.step_path;
  of_copies.gap_path = context.gap_path;
  of_copies.cell_path = context.cell_path;
  of_copies.deforming_path = context.deforming_path;
  of_copies.grid = context.grid;
  of_copies.known_overlap = context.known_overlap;
  return of_copies;
}
} // namespace

BreakingSum break_shared(const ForceContext &context,
                         const DistributedParts &parts,
                         Distribution &distribution, double time,
                         std::vector<BreakageEvent> &events)
{
  const Ranks &ranks = distribution.ranks();
  const std::set<std::int64_t> asked = asked_to_break(ranks, parts);
  CopiedContacts pairs(ranks, parts.particles, parts.pairs, nullptr, asked);
  std::vector<CopiedContacts> on_boundaries;
  for (const auto &boundary : parts.boundaries)
    on_boundaries.emplace_back(ranks, parts.particles, boundary->batch,
                               boundary.get(), asked);
  std::set<std::int64_t> ids = asked;
  for (std::size_t k = 0; k < pairs.of_pairs.size(); ++k)
    ids.insert({pairs.of_pairs.a[k], pairs.of_pairs.b[k]});
  ParticleSystem copies = copied_particles(distribution, parts.particles, ids);
  const auto row_of_id = rows_by_id(copies);
  pairs.name_by_row(row_of_id);
  const auto swap_contacts = [&]
  {
    for (std::size_t w = 0; w < on_boundaries.size(); ++w)
      parts.boundaries[w]->swap_contacts(*on_boundaries[w].on);
  };
  for (CopiedContacts &contacts : on_boundaries)
    contacts.name_by_row(row_of_id);
  swap_contacts();
  const std::size_t before = events.size();
  ContactSet contacts{pairs.of_pairs, parts.boundaries};
  const BreakingSum done =
      break_particles(with(copies, context), copies, contacts, time, events);
  swap_contacts();
  put_back(pairs, parts.pairs);
  for (std::size_t w = 0; w < on_boundaries.size(); ++w)
    on_boundaries[w].for_own(
        [&](std::size_t row, std::size_t k)
        { parts.boundaries[w]->take_contact(row, *on_boundaries[w].on, k); });
  put_back(copies, std::span(events).subspan(before),
           context.parameters.particle.density, parts.particles);
  return done;
}
} // namespace dem
