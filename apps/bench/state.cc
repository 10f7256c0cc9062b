#include "bench/state.h"

#include "run/digest.h"

#include <algorithm>
#include <span>

namespace spall
{
namespace
{
std::int64_t count_touching(const dem::ContactBatch &batch)
{
  std::int64_t n = 0;
  for (std::size_t k = 0; k < batch.size(); ++k)
    n += batch.is_touching(k);
  return n;
}
} // namespace

ContactCount count_contacts(const dem::Engine &engine)
{
  return {count_touching(engine.pairs()), count_touching(engine.on_planes()),
          static_cast<std::int64_t>(engine.pairs().size())};
}

std::size_t count_breakable(const dem::Engine &engine)
{
  return static_cast<std::size_t>(
      std::ranges::count(engine.particles().is_breakable, std::uint8_t{1}));
}

void set_velocities(dem::Engine &engine,
                    const std::vector<dem::Vec3> &velocities)
{
  dem::Particles &stones = engine.particles();
  for (std::size_t k = 0; k < stones.size(); ++k)
    stones.velocity(k) = velocities[static_cast<std::size_t>(stones.id[k])];
}

void take_places(const dem::Engine &engine, Packing &packing)
{
  const dem::Particles &stones = engine.particles();
  packing.orientation.resize(stones.size());
  for (std::size_t k = 0; k < stones.size(); ++k)
  {
    const auto id = static_cast<std::size_t>(stones.id[k]);
    packing.position[id] = stones.position(k);
    packing.orientation[id] = stones.orientation(k);
  }
}

std::uint64_t position_checksum(const dem::Engine &engine)
{
  Digest digest;
  for (const dem::StoneState &stone : engine.particles().state)
    digest.add(std::span<const double>(stone.position.data(), 3));
  return digest.value();
}
} // namespace spall
