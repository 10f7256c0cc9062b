#pragma once

#include <dem/vector.h>

#include <span>

namespace dem::detail
{
/// Volume of the convex hull by inserting point after point, to 1e-6; zero if
/// all lie in one plane.
double convex_hull_volume(std::span<const Vec3> points);
} // namespace dem::detail
