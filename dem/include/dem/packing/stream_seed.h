#pragma once

#include <cstdint>

namespace dem
{
/// Seed of one of many streams that know nothing of each other, nor of those of
/// other seeds: seed + stream would be the next seed's. SplitMix64, twice
/// (Steele, Lea & Flood 2014).
constexpr std::uint64_t stream_seed(std::uint64_t seed, std::uint64_t stream)
{
  const auto mixed = [](std::uint64_t z)
  {
    z += 0x9e3779b97f4a7c15u;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
  };
  return mixed(mixed(seed) + stream);
}
} // namespace dem
