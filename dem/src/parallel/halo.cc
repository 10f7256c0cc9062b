#include "../row_of.h"
#include "parcel_stream.h"

#include <dem/binary.h>
#include <dem/parallel/halo.h>

#include <algorithm>
#include <map>
#include <stdexcept>
#include <unordered_map>
#include <utility>

namespace dem
{
namespace
{
constexpr std::size_t load_numbers = 6;

/// Position, velocity, spin, orientation; path length where there are shapes.
void put_state(const ParticleSystem &particles, std::size_t i, double *to)
{
  const ParticleState &state = particles.state[i];
  Vec3::Map(to) = state.position;
  Vec3::Map(to + 3) = state.velocity;
  Vec3::Map(to + 6) = state.spin;
  Eigen::Vector4d::Map(to + 9) = state.orientation.coeffs();
  if (particles.has_shapes)
    to[13] = particles.path_length[i];
}

void get_state(const double *from, ParticleSystem &particles, std::size_t i)
{
  ParticleState &state = particles.state[i];
  state.position = Vec3::Map(from);
  state.velocity = Vec3::Map(from + 3);
  state.spin = Vec3::Map(from + 6);
  state.orientation.coeffs() = Eigen::Vector4d::Map(from + 9);
  if (particles.has_shapes)
    particles.path_length[i] = from[13];
}

/// Ids of the ghosts, for the ranks that own them.
std::vector<Parcel> requests(const ParticleSystem &particles,
                             const std::vector<int> &ghost_rank)
{
  std::map<int, std::vector<std::int64_t>> wanted;
  for (std::size_t g = 0; g < ghost_rank.size(); ++g)
    wanted[ghost_rank[g]].push_back(particles.id[particles.n_owned() + g]);
  std::vector<Parcel> parcels;
  for (const auto &[rank, ids] : wanted)
  {
    std::ostringstream out;
    write_column(out, ids);
    parcels.push_back(parcel_for(rank, out));
  }
  return parcels;
}
} // namespace

void Halo::plan(const Ranks &ranks, const ParticleSystem &particles,
                const std::vector<int> &ghost_rank)
{
  std::unordered_map<std::int64_t, std::int32_t> row_of_id;
  for (std::size_t i = 0; i < particles.size(); ++i)
    row_of_id[particles.id[i]] = static_cast<std::int32_t>(i);
  sent_row.clear();
  std::vector<int> destination;
  std::vector<std::int64_t> sent_id;
  for (const Parcel &from : ranks.deliver(requests(particles, ghost_rank)))
  {
    ParcelReader in(from);
    std::vector<std::int64_t> ids;
    read_column(in.stream, ids);
    for (const std::int64_t id : ids)
    {
      sent_row.push_back(row_of_id.at(id));
      sent_id.push_back(id);
      destination.push_back(from.rank);
    }
  }
  states = ranks.plan(destination);
  std::vector<std::int64_t> received_id(states->n_received());
  states->forward(sent_id.data(), sizeof(std::int64_t), received_id.data());
  ghost_row.clear();
  for (const std::int64_t id : received_id)
    ghost_row.push_back(row_of_id.at(id));
  if (ghost_row.size() != ghost_rank.size())
    throw std::logic_error("halo: some ghost is not sent by its owner");
  state_numbers = particles.has_shapes ? 14 : 13;
}

void Halo::send_states(ParticleSystem &particles)
{
  sent.resize(state_numbers * sent_row.size());
  received.resize(state_numbers * ghost_row.size());
  for (std::size_t k = 0; k < sent_row.size(); ++k)
    put_state(particles, row_of(sent_row[k]), sent.data() + state_numbers * k);
  states->forward(sent.data(), state_numbers * sizeof(double), received.data());
  for (std::size_t k = 0; k < ghost_row.size(); ++k)
    get_state(received.data() + state_numbers * k, particles,
              row_of(ghost_row[k]));
}

void Halo::collect_loads(ParticleSystem &particles)
{
  sent.resize(load_numbers * ghost_row.size());
  received.resize(load_numbers * sent_row.size());
  for (std::size_t k = 0; k < ghost_row.size(); ++k)
  {
    ParticleLoad &load = particles.load[row_of(ghost_row[k])];
    Vec3::Map(sent.data() + load_numbers * k) = load.force;
    Vec3::Map(sent.data() + load_numbers * k + 3) = load.moment;
    load = {};
  }
  states->reverse(sent.data(), load_numbers * sizeof(double), received.data());
  for (std::size_t k = 0; k < sent_row.size(); ++k)
  {
    const double *from = received.data() + load_numbers * k;
    ParticleLoad &load = particles.load[row_of(sent_row[k])];
    load.force += Vec3::Map(from);
    load.moment += Vec3::Map(from + 3);
  }
}

void Halo::collect(std::span<std::int64_t> by_row) const
{
  if (!states) // no ghosts on any rank so far
    return;
  std::vector<std::int64_t> of_ghosts, returned(sent_row.size());
  for (const std::int32_t ghost : ghost_row)
    of_ghosts.push_back(std::exchange(by_row[row_of(ghost)], 0));
  states->reverse(of_ghosts.data(), sizeof(std::int64_t), returned.data());
  for (std::size_t k = 0; k < sent_row.size(); ++k)
    by_row[row_of(sent_row[k])] += returned[k];
}

void Halo::fill(std::span<Vec3> by_row) const
{
  if (!states)
    return;
  std::vector<Vec3> of_owned, arrived(ghost_row.size());
  for (const std::int32_t owned : sent_row)
    of_owned.push_back(by_row[row_of(owned)]);
  states->forward(of_owned.data(), sizeof(Vec3), arrived.data());
  for (std::size_t k = 0; k < ghost_row.size(); ++k)
    by_row[row_of(ghost_row[k])] = arrived[k];
}

std::size_t Halo::bytes_per_step() const
{
  return (state_numbers + load_numbers) * sizeof(double) *
         (sent_row.size() + ghost_row.size());
}
} // namespace dem
