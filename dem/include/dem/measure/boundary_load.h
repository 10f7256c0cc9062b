#pragma once

#include <dem/boundary/wall_motion.h>
#include <dem/engine.h>

namespace dem
{
/// Sum of the loads of the particles of all ranks on a plane of the engine in
/// its last step, with the moment about a point; couples of rolling resistance
/// are left out. For facets see load_on(). Collective.
WallLoad load_on_plane(const Engine &engine, std::size_t plane,
                       const Vec3 &about);
/// The same of the drum, whatever its part. Collective.
WallLoad load_on_drum(const Engine &engine, const Vec3 &about);
} // namespace dem
