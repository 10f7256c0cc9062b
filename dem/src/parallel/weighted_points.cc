#include "weighted_points.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace dem
{
bool are_sound(std::span<const Vec3> points, std::span<const float> weights)
{
  return std::ranges::all_of(points,
                             [](const Vec3 &p) { return p.allFinite(); }) &&
         std::ranges::all_of(weights, [](float weight)
                             { return weight > 0.f && std::isfinite(weight); });
}

void refuse_points()
{
  throw std::invalid_argument("partition of space: a point or a weight is "
                              "wrong: must be finite, weights > 0");
}
} // namespace dem
