#pragma once

#include <dem/parallel/ranks.h>
#include <dem/particles/particle_system.h>

#include <memory>
#include <span>
#include <vector>

namespace dem
{
/// What goes between ranks in every step: states of owned particles to the
/// ranks that have them as ghosts, and loads back.
class Halo
{
public:
  /// Plans the exchange: the ghosts, in rows after the owned particles, are
  /// owned by these ranks. Collective.
  void plan(const Ranks &ranks, const ParticleSystem &particles,
            const std::vector<int> &ghost_rank);

  void send_states(ParticleSystem &particles);
  void collect_loads(ParticleSystem &particles);
  /// Of one entry for each row: those of ghosts are added to those of their
  /// owners, and become zero.
  void collect(std::span<std::int64_t> by_row) const;
  /// Of one entry for each row: those of ghosts become those of their owners.
  void fill(std::span<Vec3> by_row) const;

  std::size_t n_ghosts() const { return ghost_row.size(); }
  /// Bytes that this rank sends and receives in a step.
  std::size_t bytes_per_step() const;

private:
  std::unique_ptr<ExchangePlan> states;
  std::vector<std::int32_t> sent_row;  ///< owned, by item sent
  std::vector<std::int32_t> ghost_row; ///< by item received
  std::size_t state_numbers = 0;       ///< of one particle
  std::vector<double> sent, received;  ///< space to work in
};
} // namespace dem
