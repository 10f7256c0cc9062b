#include "bench/state.h"

#include "run/digest.h"

#include <dem/engine_boundaries.h>
#include <dem/parallel/distribution.h>

#include <algorithm>
#include <array>
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
  std::array counts{count_touching(engine.pairs()),
                    count_touching(dem::on_planes(engine)),
                    static_cast<std::int64_t>(engine.pairs().n_contacts())};
  engine.distribution().ranks().sum(counts);
  return {counts[0], counts[1], counts[2]};
}

std::size_t count_breakable(const dem::Engine &engine)
{
  const dem::ParticleSystem &particles = engine.particles();
  const auto end = particles.is_breakable.begin() +
                   static_cast<std::ptrdiff_t>(particles.n_owned());
  std::array count{static_cast<std::int64_t>(
      std::count(particles.is_breakable.begin(), end, std::uint8_t{1}))};
  engine.distribution().ranks().sum(count);
  return static_cast<std::size_t>(count[0]);
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
  const dem::ParticleSystem &particles = engine.particles();
  std::uint64_t own = 0;
  for (std::size_t k = 0; k < particles.n_owned(); ++k)
  {
    Digest digest;
    const auto id = static_cast<double>(particles.id[k]);
    digest.add(std::span(&id, 1));
    digest.add(std::span<const double>(particles.position(k).data(), 3));
    own += digest.value();
  }
  // In halves: their sums over ranks do not overflow.
  std::array halves{static_cast<std::int64_t>(own & 0xffffffffu),
                    static_cast<std::int64_t>(own >> 32)};
  engine.distribution().ranks().sum(halves);
  return static_cast<std::uint64_t>(halves[0]) +
         (static_cast<std::uint64_t>(halves[1]) << 32);
}
} // namespace spall
