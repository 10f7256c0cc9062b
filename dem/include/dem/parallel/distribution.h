#pragma once

#include <dem/boundary/boundary.h>
#include <dem/integrate/verlet.h>
#include <dem/parallel/halo.h>
#include <dem/parallel/series_pool.h>

#include <functional>
#include <memory>
#include <span>
#include <vector>

namespace dem
{
/// What of an engine belongs to single particles and goes with them.
struct DistributedParts
{
  ParticleSystem &particles;
  WorkColumns &work;
  ContactBatch &pairs;
  std::vector<CandidatePair> &pair_candidates; ///< of true surfaces
  std::span<const std::unique_ptr<Boundary>> boundaries;
};

/// Which rank has which particles of a scene (docs/developer/parallel.md). A
/// rank owns the particles whose centres are in its box, and all contacts of
/// which they are the junior side. Their partners on other ranks are ghosts:
/// rows of the columns behind those of the owned particles.
class Distribution
{
public:
  explicit Distribution(std::shared_ptr<Ranks> all) : among(std::move(all)) {}

  const Ranks &ranks() const { return *among; }
  /// There is more than one rank.
  bool is_shared() const { return among->size() > 1; }

  /// Drops the ghosts, and gives all particles with their contacts to the ranks
  /// that own them; the boxes are made again where the loads of the ranks
  /// differ by more than a tenth, or always. Partners in pairs
  /// and candidates are named by id from here on. `arrive` may add particles of
  /// this rank, wherever they are. Collective.
  void migrate(const DistributedParts &parts, bool repartitions,
               const std::function<void()> &arrive = {});
  /// Gives all particles, whoever has them, to their owners, as migrate(), with
  /// new boxes. There are no ghosts, and partners are named by id. Collective.
  void deal_out(const DistributedParts &parts);
  /// Appends ghosts: all particles that may be the senior of an owned one
  /// within a `range` between their bounding spheres [m], of circumscribed or
  /// equivalent spheres. Partners are named by row again; those that are
  /// too far to be ghosts have rows past the last. Collective.
  void add_ghosts(const DistributedParts &parts, double range,
                  bool reads_shape);
  /// Keeps the ghosts that `is_named` marks, by row, with their series, and
  /// plans the exchange. Returns the new row of every old one, -1 of those that
  /// are gone. Collective.
  std::vector<std::int32_t>
  keep_ghosts(const DistributedParts &parts,
              const std::vector<std::uint8_t> &is_named);

  /// Ghosts get the states of their particles. Collective.
  void send_states(ParticleSystem &particles) { halo.send_states(particles); }
  /// Loads of the ghosts are added to those of their particles. Collective.
  void collect_loads(ParticleSystem &particles)
  {
    halo.collect_loads(particles);
  }

  const Halo &exchange() const { return halo; }
  SeriesPool &series() { return pool; }
  std::int64_t n_partitions() const { return partition_count; }

private:
  void send_home(const DistributedParts &parts, bool repartitions);
  void partition(const DistributedParts &parts, bool always);

  std::shared_ptr<Ranks> among;
  Halo halo;
  SeriesPool pool;
  std::vector<int> ghost_rank; ///< owner of each ghost
  std::vector<SeriesKey> ghost_series;
  std::int64_t partition_count = 0;
};
} // namespace dem
