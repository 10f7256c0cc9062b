#pragma once

#include <dem/boundary/wall_motion.h>
#include <dem/engine.h>

namespace dem
{
/// Sum of the loads of the particles on a plane of the engine in its last step,
/// with the moment about a point; couples of rolling resistance are left out.
/// On many ranks of Engine::gathered(). For facets see load_on().
WallLoad load_on_plane(const Engine &engine, std::size_t plane,
                       const Vec3 &about);
/// The same of the drum, whatever its part.
WallLoad load_on_drum(const Engine &engine, const Vec3 &about);
} // namespace dem
