#pragma once

#include <dem/parallel/distribution.h>

#include <vector>

/// How the work of a step is shared between ranks.
namespace dem
{
/// Cost of each owned particle in a step, by the contacts that it is the junior
/// of, over that of some 2.5 pairs of spheres [-].
std::vector<float> weights(const DistributedParts &parts);

/// Largest weight of a rank over the mean [-]. Collective.
double imbalance(const Ranks &ranks, const std::vector<float> &weight);
} // namespace dem
