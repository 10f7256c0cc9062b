#include "balance.h"
#include "parcel_stream.h"
#include "particle_stream.h"

#include <dem/binary.h>
#include <dem/neighbor/space_order.h>
#include <dem/parallel/distribution.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <unordered_map>

namespace dem
{
namespace
{
using Rows = std::vector<std::int32_t>;

std::size_t row_of(std::int32_t particle)
{
  return static_cast<std::size_t>(particle);
}

template <class Call>
void visit_batches(const DistributedParts &parts, const Call &call)
{
  call(parts.pairs);
  for (const auto &boundary : parts.boundaries)
    call(boundary->batch);
}

/// Numbers of the contacts whose particle A keeps a row.
Rows kept_contacts(const ContactBatch &batch, const Rows &new_row)
{
  Rows kept;
  for (std::size_t k = 0; k < batch.size(); ++k)
    if (new_row[row_of(batch.a[k])] >= 0)
      kept.push_back(static_cast<std::int32_t>(k));
  return kept;
}

/// Calls call(candidates) for those of pairs and of each boundary that has
/// some.
template <class Call>
void visit_candidates(const DistributedParts &parts, const Call &call)
{
  call(parts.pair_candidates);
  for (const auto &boundary : parts.boundaries)
    if (std::vector<CandidatePair> *candidates = boundary->candidates())
      call(*candidates);
}

/// Calls call(partner) for the partners of all pairs.
template <class Call>
void visit_partners(const DistributedParts &parts, const Call &call)
{
  for (std::size_t k = 0; k < parts.pairs.size(); ++k)
    call(parts.pairs.b[k]);
  for (CandidatePair &pair : parts.pair_candidates)
    call(pair.key.second);
}

void sort_pairs(const DistributedParts &parts)
{
  parts.pairs.rearrange(parts.pairs.layout, parts.pairs.by_pair());
  std::ranges::sort(parts.pair_candidates, {}, &CandidatePair::key);
}

/// The partner of every pair by its id: rows are about to change.
void name_partners_by_id(const DistributedParts &parts)
{
  visit_partners(parts,
                 [&parts](std::int32_t &partner) {
                   partner = static_cast<std::int32_t>(
                       parts.particles.id[row_of(partner)]);
                 });
}

/// And by its row again; partners that are not here have rows past the last.
void name_partners_by_row(const DistributedParts &parts)
{
  std::unordered_map<std::int64_t, std::int32_t> row_of_id;
  for (std::size_t i = 0; i < parts.particles.size(); ++i)
    row_of_id[parts.particles.id[i]] = static_cast<std::int32_t>(i);
  auto next = static_cast<std::int32_t>(parts.particles.size());
  visit_partners(parts,
                 [&](std::int32_t &partner)
                 {
                   const auto found = row_of_id.find(partner);
                   partner = found == row_of_id.end() ? next++ : found->second;
                 });
  sort_pairs(parts);
}

/// Ghosts have got other rows, or are gone (-1).
void renumber_partners(const Rows &new_row, const DistributedParts &parts)
{
  auto next = static_cast<std::int32_t>(parts.particles.size());
  visit_partners(parts,
                 [&](std::int32_t &partner)
                 {
                   const std::size_t b = row_of(partner);
                   partner = b < new_row.size() && new_row[b] >= 0 ? new_row[b]
                                                                   : next++;
                 });
  sort_pairs(parts);
}

void drop_ghosts(ParticleSystem &particles)
{
  Rows owned(particles.n_owned());
  std::iota(owned.begin(), owned.end(), 0);
  particles.n_ghosts = 0;
  particles.reorder(owned);
}

/// The owned particles are these, in this order; contacts of others go.
void keep_particles(const DistributedParts &parts, const Rows &order)
{
  Rows new_row(parts.particles.size(), -1);
  for (std::size_t k = 0; k < order.size(); ++k)
    new_row[row_of(order[k])] = static_cast<std::int32_t>(k);
  parts.particles.reorder(order);
  reorder_column(parts.work.damped, order);
  reorder_column(parts.work.lifted, order);
  parts.pairs = parts.pairs.select(kept_contacts(parts.pairs, new_row));
  for (const auto &boundary : parts.boundaries)
  {
    boundary->keep_contacts(kept_contacts(boundary->batch, new_row));
    boundary->keep_particles(new_row);
  }
  visit_batches(parts,
                [&new_row](ContactBatch &batch)
                {
                  for (std::size_t k = 0; k < batch.size(); ++k)
                    batch.a[k] = new_row[row_of(batch.a[k])];
                });
  visit_candidates(parts,
                   [&new_row](std::vector<CandidatePair> &candidates)
                   {
                     for (CandidatePair &pair : candidates)
                       pair.key.first = new_row[row_of(pair.key.first)];
                     std::erase_if(candidates, [](const CandidatePair &pair)
                                   { return pair.key.first < 0; });
                   });
}

void sort_in_space(const DistributedParts &parts)
{
  keep_particles(parts,
                 space_order(parts.particles.column(&ParticleState::position)));
}

/// Particles that leave for one rank, and where each of them stands in the
/// parcel.
struct Leaving
{
  Rows rows;
  std::unordered_map<std::int32_t, std::int32_t> number;

  void add(std::int32_t row)
  {
    number[row] = static_cast<std::int32_t>(rows.size());
    rows.push_back(row);
  }
};

/// Returns their numbers.
Rows write_contacts(std::ostream &out, const ContactBatch &batch,
                    const Leaving &leaving)
{
  Rows rows, particles;
  for (std::size_t k = 0; k < batch.size(); ++k)
    if (const auto found = leaving.number.find(batch.a[k]);
        found != leaving.number.end())
    {
      rows.push_back(static_cast<std::int32_t>(k));
      particles.push_back(found->second);
    }
  ContactBatch some = batch.select(rows);
  std::copy(particles.begin(), particles.end(), some.a.begin());
  write_batch(out, some);
  return rows;
}

void read_contacts(std::istream &in, std::size_t first_row, ContactBatch &batch)
{
  ContactBatch more;
  read_batch(in, more);
  for (std::size_t k = 0; k < more.size(); ++k)
    more.a[k] += static_cast<std::int32_t>(first_row);
  batch.append(more);
}

void write_candidates(std::ostream &out,
                      const std::vector<CandidatePair> &candidates,
                      const Leaving &leaving)
{
  std::vector<CandidatePair> some;
  for (const CandidatePair &pair : candidates)
    if (const auto found = leaving.number.find(pair.key.first);
        found != leaving.number.end())
      some.emplace_back(pair).key.first = found->second;
  write_column(out, some);
}

void read_candidates(std::istream &in, std::size_t first_row,
                     std::vector<CandidatePair> &candidates)
{
  std::vector<CandidatePair> more;
  read_column(in, more);
  for (CandidatePair &pair : more)
    pair.key.first += static_cast<std::int32_t>(first_row);
  candidates.insert(candidates.end(), more.begin(), more.end());
}

Parcel pack(const DistributedParts &parts, int rank, const Leaving &leaving,
            SeriesPool &pool)
{
  std::ostringstream out;
  write_particles(out, parts.particles, leaving.rows, pool);
  write_column(out, selected(parts.work.damped, leaving.rows));
  write_column(out, selected(parts.work.lifted, leaving.rows));
  write_contacts(out, parts.pairs, leaving);
  for (const auto &boundary : parts.boundaries)
  {
    boundary->pack_contacts(out, write_contacts(out, boundary->batch, leaving));
    boundary->pack_particles(out, leaving.rows);
  }
  visit_candidates(parts, [&](const std::vector<CandidatePair> &candidates)
                   { write_candidates(out, candidates, leaving); });
  return parcel_for(rank, out);
}

template <class Entry>
void append_column(std::istream &in, std::vector<Entry> &column)
{
  std::vector<Entry> more;
  read_column(in, more);
  column.insert(column.end(), more.begin(), more.end());
}

/// Returns how many particles have come.
std::size_t unpack(const Parcel &parcel, const DistributedParts &parts,
                   std::vector<SeriesKey> &series)
{
  ParcelReader in(parcel);
  const std::size_t first = parts.particles.size();
  const std::size_t n = read_particles(in.stream, parts.particles, series);
  append_column(in.stream, parts.work.damped);
  append_column(in.stream, parts.work.lifted);
  read_contacts(in.stream, first, parts.pairs);
  for (const auto &boundary : parts.boundaries)
  {
    read_contacts(in.stream, first, boundary->batch);
    boundary->unpack_contacts(in.stream);
    boundary->unpack_particles(in.stream, first);
  }
  visit_candidates(parts, [&](std::vector<CandidatePair> &candidates)
                   { read_candidates(in.stream, first, candidates); });
  return n;
}

double reach_of(const ParticleSystem &particles, std::size_t i,
                bool reads_shape)
{
  return reads_shape ? particles.shape[i].circumscribed_radius
                     : particles.radius(i);
}

/// How far a junior particle of an owned one may reach from its centre [m].
class JuniorReach
{
public:
  /// Collective.
  JuniorReach(const Ranks &ranks, const ParticleSystem &all, bool by_shape)
      : particles(all)
  {
    std::array bounds{0., 0.};
    for (std::size_t i = 0; i < particles.size(); ++i)
    {
      const double reach = reach_of(particles, i, by_shape);
      bounds[0] = std::max(bounds[0], reach);
      bounds[1] = std::max(bounds[1], reach / particles.radius(i));
    }
    ranks.max(bounds);
    largest = bounds[0];
    aspect = bounds[1];
  }

  /// A junior was no heavier at first, so no larger unless its material is
  /// another one.
  double operator()(std::size_t senior) const
  {
    if (particles.has_materials)
      return largest;
    const double first_radius =
        particles.radius(senior) * std::cbrt(particles.initial_mass[senior] /
                                             particles.solid_mass(senior));
    return std::min(largest, 1.0001 * aspect * first_radius);
  }

private:
  const ParticleSystem &particles;
  double largest = 0., aspect = 1.;
};
} // namespace

void Distribution::partition(const DistributedParts &parts, bool always)
{
  constexpr double tolerated = 1.1;
  const std::vector<float> weight = weights(parts);
  if (partition_count > 0 && !always && imbalance(*among, weight) <= tolerated)
    return;
  among->partition(parts.particles.column(&ParticleState::position), weight);
  ++partition_count;
}

void Distribution::fetch_series(
    ParticleSystem &particles, std::size_t first,
    const std::vector<std::pair<int, SeriesKey>> &keys)
{
  if (!particles.has_shapes)
    return;
  const auto found = pool.fetch(*among, keys);
  for (std::size_t k = 0; k < found.size(); ++k)
    particles.shape[first + k].series = found[k];
}

void Distribution::migrate(const DistributedParts &parts, bool repartitions,
                           const std::function<void()> &arrive)
{
  name_partners_by_id(parts);
  drop_ghosts(parts.particles);
  if (arrive)
    arrive();
  send_home(parts, repartitions);
}

void Distribution::deal_out(const DistributedParts &parts)
{
  name_partners_by_id(parts);
  Rows own;
  for (std::size_t i = 0; i < parts.particles.size(); ++i)
    if (parts.particles.id[i] % among->size() == among->rank())
      own.push_back(static_cast<std::int32_t>(i));
  keep_particles(parts, own);
  send_home(parts, true);
}

void Distribution::gather(const DistributedParts &from,
                          const DistributedParts &into)
{
  ContactBatch pairs = from.pairs;
  std::vector<CandidatePair> candidates = from.pair_candidates;
  const DistributedParts named{from.particles, from.work, pairs, candidates,
                               from.boundaries};
  name_partners_by_id(named);
  Leaving own;
  for (std::size_t i = 0; i < from.particles.n_owned(); ++i)
    own.add(static_cast<std::int32_t>(i));
  constexpr int first_rank = 0;
  std::vector<Parcel> parcels;
  parcels.push_back(pack(named, first_rank, own, pool));
  std::vector<std::pair<int, SeriesKey>> wanted;
  for (const Parcel &parcel : among->deliver(std::move(parcels)))
  {
    std::vector<SeriesKey> series;
    unpack(parcel, into, series);
    for (const SeriesKey &key : series)
      wanted.emplace_back(parcel.rank, key);
  }
  fetch_series(into.particles, 0, wanted);
  into.particles.renew_frames();
  name_partners_by_row(into);
}

/// Partners are named by id.
void Distribution::send_home(const DistributedParts &parts, bool repartitions)
{
  ParticleSystem &particles = parts.particles;
  pool.prune();
  partition(parts, repartitions);
  std::vector<Leaving> leaving(static_cast<std::size_t>(among->size()));
  Rows staying;
  for (std::size_t i = 0; i < particles.size(); ++i)
  {
    const int owner = among->owner(particles.position(i));
    const auto row = static_cast<std::int32_t>(i);
    if (owner == among->rank())
      staying.push_back(row);
    else
      leaving[static_cast<std::size_t>(owner)].add(row);
  }
  std::vector<Parcel> parcels;
  for (int rank = 0; rank < among->size(); ++rank)
    if (const Leaving &some = leaving[static_cast<std::size_t>(rank)];
        !some.rows.empty())
      parcels.push_back(pack(parts, rank, some, pool));
  keep_particles(parts, staying);
  std::vector<std::pair<int, SeriesKey>> wanted;
  for (const Parcel &parcel : among->deliver(std::move(parcels)))
  {
    std::vector<SeriesKey> series;
    unpack(parcel, parts, series);
    for (const SeriesKey &key : series)
      wanted.emplace_back(parcel.rank, key);
  }
  fetch_series(particles, staying.size(), wanted);
  particles.renew_frames();
  sort_in_space(parts);
  for (const auto &boundary : parts.boundaries)
    boundary->sort_contacts();
  visit_candidates(parts, [](std::vector<CandidatePair> &candidates)
                   { std::ranges::sort(candidates, {}, &CandidatePair::key); });
}

void Distribution::add_ghosts(const DistributedParts &parts, double range,
                              bool reads_shape)
{
  ParticleSystem &particles = parts.particles;
  const JuniorReach junior_reach(*among, particles, reads_shape);
  std::vector<Rows> seen_by(static_cast<std::size_t>(among->size()));
  std::vector<int> ranks;
  for (std::size_t i = 0; i < particles.size(); ++i)
  {
    const Vec3 box = Vec3::Constant(reach_of(particles, i, reads_shape) +
                                    junior_reach(i) + range);
    among->owners(particles.position(i) - box, particles.position(i) + box,
                  ranks);
    for (const int rank : ranks)
      if (rank != among->rank())
        seen_by[static_cast<std::size_t>(rank)].push_back(
            static_cast<std::int32_t>(i));
  }
  std::vector<Parcel> parcels;
  for (int rank = 0; rank < among->size(); ++rank)
    if (const Rows &rows = seen_by[static_cast<std::size_t>(rank)];
        !rows.empty())
    {
      std::ostringstream out;
      write_particles(out, particles, rows, pool);
      parcels.push_back(parcel_for(rank, out));
    }
  ghost_rank.clear();
  ghost_series.clear();
  for (const Parcel &parcel : among->deliver(std::move(parcels)))
  {
    ParcelReader in(parcel);
    const std::size_t n = read_particles(in.stream, particles, ghost_series);
    ghost_rank.insert(ghost_rank.end(), n, parcel.rank);
  }
  particles.n_ghosts = ghost_rank.size();
  // What acts on a particle is known to its owner.
  std::fill(particles.load.end() -
                static_cast<std::ptrdiff_t>(particles.n_ghosts),
            particles.load.end(), ParticleLoad{});
  particles.renew_frames();
  name_partners_by_row(parts);
}

std::vector<std::int32_t>
Distribution::keep_ghosts(const DistributedParts &parts,
                          const std::vector<std::uint8_t> &is_named)
{
  ParticleSystem &particles = parts.particles;
  const std::size_t n_owned = particles.n_owned();
  Rows order(n_owned), new_row(particles.size(), -1), kept;
  std::iota(order.begin(), order.end(), 0);
  std::copy(order.begin(), order.end(), new_row.begin());
  for (std::size_t g = 0; g < particles.n_ghosts; ++g)
    if (is_named[n_owned + g])
    {
      new_row[n_owned + g] = static_cast<std::int32_t>(order.size());
      order.push_back(static_cast<std::int32_t>(n_owned + g));
      kept.push_back(static_cast<std::int32_t>(g));
    }
  particles.reorder(order);
  particles.n_ghosts = kept.size();
  renumber_partners(new_row, parts);
  ghost_rank = selected(ghost_rank, kept);
  ghost_series = selected(ghost_series, kept);
  halo.plan(*among, particles, ghost_rank);
  std::vector<std::pair<int, SeriesKey>> wanted;
  for (std::size_t g = 0; g < kept.size(); ++g)
    wanted.emplace_back(ghost_rank[g], ghost_series[g]);
  fetch_series(particles, n_owned, wanted);
  particles.renew_frames();
  return new_row;
}
} // namespace dem
