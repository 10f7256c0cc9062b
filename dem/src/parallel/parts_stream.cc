#include "parts_stream.h"

#include "parcel_stream.h"
#include "particle_stream.h"

#include <dem/binary.h>

namespace dem
{
namespace
{
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

template <class Entry>
void append_column(std::istream &in, std::vector<Entry> &column)
{
  std::vector<Entry> more;
  read_column(in, more);
  column.insert(column.end(), more.begin(), more.end());
}
} // namespace

void write_parts(std::ostream &out, const DistributedParts &parts,
                 const Leaving &leaving)
{
  write_particles(out, parts.particles, leaving.rows);
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
}

void read_parts(std::istream &in, const DistributedParts &parts)
{
  const std::size_t first = parts.particles.size();
  read_particles(in, parts.particles);
  append_column(in, parts.work.damped);
  append_column(in, parts.work.lifted);
  read_contacts(in, first, parts.pairs);
  for (const auto &boundary : parts.boundaries)
  {
    read_contacts(in, first, boundary->batch);
    boundary->unpack_contacts(in);
    boundary->unpack_particles(in, first);
  }
  visit_candidates(parts, [&](std::vector<CandidatePair> &candidates)
                   { read_candidates(in, first, candidates); });
}

Parcel parcel_of(const DistributedParts &parts, int rank,
                 const Leaving &leaving, SeriesPool &pool)
{
  std::ostringstream out;
  write_parts(out, parts, leaving);
  write_column(out, series_keys(parts.particles, leaving.rows, pool));
  return parcel_for(rank, out);
}

void take_parcels(const std::vector<Parcel> &parcels, const Ranks &ranks,
                  const DistributedParts &parts, SeriesPool &pool)
{
  const std::size_t first = parts.particles.size();
  std::vector<std::pair<int, SeriesKey>> wanted;
  for (const Parcel &parcel : parcels)
  {
    ParcelReader in(parcel);
    read_parts(in.stream, parts);
    std::vector<SeriesKey> keys;
    read_column(in.stream, keys);
    for (const SeriesKey &key : keys)
      wanted.emplace_back(parcel.rank, key);
  }
  fetch_series(ranks, pool, wanted, first, parts.particles);
}
} // namespace dem
