#pragma once

#include <dem/shape/polygon.h>

#include <functional>

namespace spall
{
/// The space that particles fill, from what they lie on to what is on them.
struct SliceSpace
{
  double low = 0., high = 0.; ///< z of its ends [m]
  /// Its section at this z [m].
  std::function<dem::Polygon(double z)> section;
};
} // namespace spall
