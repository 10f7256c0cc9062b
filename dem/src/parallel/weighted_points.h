#pragma once

#include <dem/vector.h>

#include <span>

namespace dem
{
/// Whether Ranks::partition() may use them: all finite, and weights > 0.
bool are_sound(std::span<const Vec3> points, std::span<const float> weights);
/// Throws std::invalid_argument about points that are not sound.
[[noreturn]] void refuse_points();
} // namespace dem
