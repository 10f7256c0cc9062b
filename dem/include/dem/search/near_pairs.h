#pragma once

#include <dem/particles.h>

#include <cstdint>
#include <utility>
#include <vector>

namespace dem
{
/// Two stones, the one with the lower number first.
using PairKey = std::pair<std::int32_t, std::int32_t>;

/// All pairs of stones with a gap below `margin` [m], sorted: between the
/// balls, or with `is_radial` between the radii along the branch. Stones are
/// filed by size: classes of a factor of two with a grid each, so that the cost
/// per stone does not grow with the ratio of sizes.
std::vector<PairKey> near_pairs(const Particles &particles, bool is_radial,
                                double margin);
} // namespace dem
