#include "balance.h"
#include "parcel_stream.h"
#include "particle_stream.h"
#include "parts.h"
#include "parts_stream.h"

#include <dem/binary.h>
#include <dem/neighbor/space_order.h>
#include <dem/parallel/distribution.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace dem
{
namespace
{
void sort_in_space(const DistributedParts &parts)
{
  keep_particles(parts,
                 space_order(parts.particles.column(&ParticleState::position)));
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
  send_home(parts, true);
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
      parcels.push_back(parcel_of(parts, rank, some, pool));
  keep_particles(parts, staying);
  take_parcels(among->deliver(std::move(parcels)), *among, parts, pool);
  particles.renew_frames();
  sort_in_space(parts);
  sort_contacts(parts);
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
      write_particles(out, particles, rows);
      write_column(out, series_keys(particles, rows, pool));
      parcels.push_back(parcel_for(rank, out));
    }
  ghost_rank.clear();
  ghost_series.clear();
  for (const Parcel &parcel : among->deliver(std::move(parcels)))
  {
    ParcelReader in(parcel);
    const std::size_t n = read_particles(in.stream, particles);
    std::vector<SeriesKey> keys;
    read_column(in.stream, keys);
    ghost_series.insert(ghost_series.end(), keys.begin(), keys.end());
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
  fetch_series(*among, pool, wanted, n_owned, particles);
  particles.renew_frames();
  return new_row;
}
} // namespace dem
