#pragma once

#include <dem/parallel/ranks.h>
#include <dem/shape/particle_shape.h>

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <vector>

namespace dem
{
/// Names a series of coefficients on every rank: a hash of its numbers; zero
/// for a sphere.
using SeriesKey = std::array<std::uint64_t, 2>;

/// The series of the particles of a rank, by key: a series is sent to a rank
/// once, and particles of one shape share it there as they do here.
class SeriesPool
{
public:
  /// Key of a series, which the pool knows from now on.
  SeriesKey add(const std::shared_ptr<const Coefficients> &series);

  /// The series of these keys, in their order; null for spheres. What the pool
  /// lacks is asked of the rank that is named beside the key. Collective.
  std::vector<std::shared_ptr<const Coefficients>>
  fetch(const Ranks &ranks,
        const std::vector<std::pair<int, SeriesKey>> &wanted);

  /// Forgets what no particle has any more.
  void prune();

private:
  void deliver_series(const Ranks &ranks, const std::vector<Parcel> &asked);

  std::map<SeriesKey, std::shared_ptr<const Coefficients>> series_of;
  std::map<const Coefficients *, SeriesKey> key_of;
};
} // namespace dem
