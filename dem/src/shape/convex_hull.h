#pragma once

#include <dem/vector.h>

#include <span>

namespace dem::detail
{
/// Volume of the convex hull by inserting point after point; zero if all lie
/// in one plane. Points closer to a face than 1e-12 of the extent are inside.
double convex_hull_volume(std::span<const Vec3> points);
} // namespace dem::detail
