#pragma once

#include <cstdint>

/// Evaluation of maps of particles (RadiusMap), compiled for each
/// instruction set. Plain pointers only: what is inline here would otherwise be
/// linked from the unit with the widest instructions.
namespace dem::kernel
{
/// The nodes of a map, RadiusMap::nodes, and the length of a row of their radii
/// (GridValues), of which there is one more before the first ring.
inline constexpr int map_rings = 48, map_columns = 96,
                     map_row = map_columns + 1;
inline constexpr int map_nodes = map_rings * map_columns;
/// Lists have room for so many entries more than they hold.
inline constexpr int map_spare = 16;

/// Sine and cosine of the polar angle of every ring and of the azimuth of every
/// column.
struct MapAngles
{
  alignas(64) float sine[map_rings], cosine[map_rings];
  alignas(64) float column_sine[map_columns], column_cosine[map_columns];
};

/// Columns of points; entries past the last are overwritten.
struct PointRows
{
  float *x, *y, *z;
};

/// The map of a particle with its size.
struct MapView
{
  const float *radius; ///< in units of `scale`
  float scale;         ///< [m]
};

/// A particle whose distances from points are evaluated.
struct MapField
{
  MapView map;
  float centre[3]; ///< where the points have theirs [m]
  float
      rotation[9]; ///< row by row, body frame of the particle to that of points
  float reach;     ///< farther from its centre is infinitely far [m]
};

struct MapLoops
{
  /// Lists the nodes that are higher than `lowest` along a unit vector `up`,
  /// and where they are [m]. Returns their number.
  int (*nodes_above)(const MapAngles &angles, const MapView &map,
                     const float *up, float lowest, std::int32_t *node,
                     const PointRows &points);
  /// Gaps of n points from a particle: along the ray from its centre, times the
  /// cosine between ray and normal there; < 0 inside [m].
  void (*gaps)(const MapField &field, const PointRows &points, int n,
               float *gap);
};

/// Those of the instruction set in use.
const MapLoops &map_loops();

namespace baseline
{
extern const MapLoops map_loops;
}
namespace avx2
{
extern const MapLoops map_loops;
}
namespace avx512
{
extern const MapLoops map_loops;
}
} // namespace dem::kernel
