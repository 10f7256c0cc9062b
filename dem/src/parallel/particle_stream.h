#pragma once

#include <dem/contact/batch_stream.h>
#include <dem/parallel/series_pool.h>
#include <dem/particles/particle_system.h>

#include <cstdint>
#include <iosfwd>
#include <vector>

/// Rows of the columns of particles to and from parcels.
namespace dem
{
/// These rows of all columns, without the series of the particles.
void write_particles(std::ostream &out, const ParticleSystem &particles,
                     const std::vector<std::int32_t> &rows);
/// Appends the rows; their series are null. Returns how many there were.
std::size_t read_particles(std::istream &in, ParticleSystem &particles);

/// Keys of the series of these rows, in their order.
std::vector<SeriesKey> series_keys(const ParticleSystem &particles,
                                   const std::vector<std::int32_t> &rows,
                                   SeriesPool &pool);

/// Gives particles from row `first` on the series of these keys, each beside
/// the rank that has it. Collective.
void fetch_series(const Ranks &ranks, SeriesPool &pool,
                  const std::vector<std::pair<int, SeriesKey>> &keys,
                  std::size_t first, ParticleSystem &particles);

/// Entries of a column.
template <class Entry>
std::vector<Entry> selected(const std::vector<Entry> &column,
                            const std::vector<std::int32_t> &rows)
{
  std::vector<Entry> some;
  some.reserve(rows.size());
  for (const std::int32_t row : rows)
    some.push_back(column[static_cast<std::size_t>(row)]);
  return some;
}
} // namespace dem
