#include "bench/state.h"

#include "run/digest.h"

#include <dem/engine_boundaries.h>

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
  return {count_touching(engine.pairs()),
          count_touching(dem::on_planes(engine)),
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
  dem::ParticleSystem &particles = engine.particles();
  for (std::size_t k = 0; k < particles.size(); ++k)
    particles.velocity(k) =
        velocities[static_cast<std::size_t>(particles.id[k])];
}

void take_positions(const dem::Engine &engine, Packing &packing)
{
  const dem::ParticleSystem &particles = engine.particles();
  packing.orientation.resize(particles.size());
  for (std::size_t k = 0; k < particles.size(); ++k)
  {
    const auto id = static_cast<std::size_t>(particles.id[k]);
    packing.position[id] = particles.position(k);
    packing.orientation[id] = particles.orientation(k);
  }
}

std::uint64_t position_checksum(const dem::Engine &engine)
{
  Digest digest;
  for (const dem::ParticleState &particle : engine.particles().state)
    digest.add(std::span<const double>(particle.position.data(), 3));
  return digest.value();
}
} // namespace spall
