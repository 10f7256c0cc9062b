#pragma once

#include <dem/boundary/facet_surface.h>

#include <vector>

namespace dem
{
/// Where spheres may be placed beside rigid walls, whose facets show away from
/// the particles: no facet is nearer than the radius, and the centre is on the
/// right side of every closed wall. An open wall has no other side that could
/// be told from its own.
class WallClearance
{
public:
  /// Adds a wall as it is now.
  void add(const FacetSurface &surface);
  bool is_empty() const { return walls.empty(); }
  /// Whether a sphere about `centre` is clear of all walls.
  bool is_clear(const Vec3 &centre, double radius) const;

private:
  struct Wall
  {
    FacetSurface surface;
    Vec3 lower, upper; ///< of its vertices [m]
    bool is_closed = false;
    bool holds_particles = false; ///< closed: they are inside
  };

  std::vector<Wall> walls;
};
} // namespace dem
