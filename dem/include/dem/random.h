#pragma once

#include <dem/vector.h>

#include <cstdint>
#include <random>

namespace dem
{
/// Random numbers that are the same on every machine for one seed.
class Random
{
public:
  explicit Random(std::uint64_t seed) : bits(seed) {}

  /// Uniform in [0, 1) [-].
  double uniform() { return static_cast<double>(bits() >> 11) * 0x1p-53; }

  /// Uniform over [0, n).
  std::size_t below(std::size_t n)
  {
    return static_cast<std::size_t>(uniform() * static_cast<double>(n));
  }

  /// Uniform over all rotations (Shoemake 1992).
  Quaternion rotation();

private:
  std::mt19937_64 bits;
};
} // namespace dem
