#include <dem/contact/pair_loads.h>

#include <algorithm>
#include <limits>
#include <tuple>
#include <utility>

namespace dem
{
namespace
{
/// Load on a particle that its range does not own.
struct Foreign
{
  std::int32_t particle = 0, range = 0, contact = 0;

  bool operator<(const Foreign &other) const
  {
    return std::tie(particle, range, contact) <
           std::tie(other.particle, other.range, other.contact);
  }
};

std::vector<Foreign> find_foreign(const ContactBatch &pairs)
{
  const auto n = static_cast<std::int64_t>(pairs.size());
  const std::int64_t size = range_size(n);
  std::vector<Foreign> foreign;
  for (std::int64_t first = 0; first < n; first += size)
  {
    const std::int64_t last = std::min(first + size, n);
    const std::int32_t begin = pairs.a[static_cast<std::size_t>(first)];
    const std::int32_t end = last < n
                                 ? pairs.a[static_cast<std::size_t>(last)]
                                 : std::numeric_limits<std::int32_t>::max();
    for (std::int64_t k = first; k < last; ++k)
      if (const std::int32_t b = pairs.b[static_cast<std::size_t>(k)];
          b <= begin || b >= end)
        foreign.push_back({b, static_cast<std::int32_t>(first / size),
                           static_cast<std::int32_t>(k)});
  }
  std::sort(foreign.begin(), foreign.end());
  return foreign;
}
} // namespace

std::int64_t range_size(std::int64_t n_contacts)
{
  constexpr auto block = static_cast<std::int64_t>(ContactBatch::block);
  const std::int64_t least = std::clamp<std::int64_t>(n_contacts / 8, 64, 256);
  const std::int64_t size =
      std::clamp<std::int64_t>(n_contacts / 32, least, 8192);
  return (size + block - 1) / block * block;
}

void PairLoads::prepare(ContactBatch &pairs)
{
  std::copy(pairs.b.begin(), pairs.b.end(), pairs.target.begin());
  particle.clear();
  start.assign(1, 0);
  std::int32_t n_rows = 0;
  Foreign before{-1, -1, -1};
  for (const Foreign &one : find_foreign(pairs))
  {
    const bool is_new_particle = one.particle != before.particle;
    if (is_new_particle)
    {
      particle.push_back(one.particle);
      start.push_back(n_rows);
    }
    if (is_new_particle || one.range != before.range)
      start.back() = ++n_rows;
    pairs.target[static_cast<std::size_t>(one.contact)] = -n_rows;
    before = one;
  }
  halo.assign(static_cast<std::size_t>(n_rows), ParticleLoad{});
}

void PairLoads::add_halo(std::vector<ParticleLoad> &load)
{
  const auto n = static_cast<std::int64_t>(particle.size());
  // A few rows are added sooner than threads are woken.
#pragma omp parallel for schedule(static) if (n >= 256)
  for (std::int64_t s = 0; s < n; ++s)
  {
    const auto entry = static_cast<std::size_t>(s);
    ParticleLoad &sum = load[static_cast<std::size_t>(particle[entry])];
    for (std::int32_t row = start[entry]; row < start[entry + 1]; ++row)
      sum += std::exchange(halo[static_cast<std::size_t>(row)], ParticleLoad{});
  }
}
} // namespace dem
