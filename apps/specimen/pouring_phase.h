#pragma once

#include <dem/packing/pouring.h>

#include <string>

namespace spall
{
/// What the layer that comes in does at this time [s], for the line of
/// progress: "layer 2 of 3 settles, 1.35 s".
std::string pouring_phase(const dem::Pouring &pouring, double time);
} // namespace spall
