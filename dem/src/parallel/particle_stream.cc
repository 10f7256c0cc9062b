#include "particle_stream.h"

#include <dem/binary.h>
#include <dem/shape/shape_stream.h>

namespace dem
{
void write_particles(std::ostream &out, const ParticleSystem &particles,
                     const std::vector<std::int32_t> &rows)
{
  ParticleSystem::visit(particles, [&](const auto &column)
                        { write_column(out, selected(column, rows)); });
  for (const std::int32_t row : rows)
    write_measures(out, particles.shape[static_cast<std::size_t>(row)]);
}

std::size_t read_particles(std::istream &in, ParticleSystem &particles)
{
  const std::size_t before = particles.size();
  ParticleSystem::visit(particles,
                        [&in](auto &column)
                        {
                          std::decay_t<decltype(column)> more;
                          read_column(in, more);
                          column.insert(column.end(), more.begin(), more.end());
                        });
  particles.shape.resize(particles.size());
  for (std::size_t i = before; i < particles.size(); ++i)
    read_measures(in, particles.shape[i]);
  return particles.size() - before;
}

std::vector<SeriesKey> series_keys(const ParticleSystem &particles,
                                   const std::vector<std::int32_t> &rows,
                                   SeriesPool &pool)
{
  std::vector<SeriesKey> keys;
  for (const std::int32_t row : rows)
    keys.push_back(
        pool.add(particles.shape[static_cast<std::size_t>(row)].series));
  return keys;
}

void fetch_series(const Ranks &ranks, SeriesPool &pool,
                  const std::vector<std::pair<int, SeriesKey>> &keys,
                  std::size_t first, ParticleSystem &particles)
{
  if (!particles.has_shapes)
    return;
  const auto found = pool.fetch(ranks, keys);
  for (std::size_t k = 0; k < found.size(); ++k)
    particles.shape[first + k].series = found[k];
}
} // namespace dem
