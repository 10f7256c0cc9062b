#pragma once

#include <dem/boundary/wall_clearance.h>
#include <dem/shape/polygon.h>

#include <array>
#include <cstdint>
#include <vector>

namespace dem
{
enum class ContainerBottom
{
  closed,
  open ///< particles lie on what is at z = 0 there
};

/// The inside of a container of any shape: rigid walls round the particles,
/// open at the top. Above its rim the walls continue upward as a collar, below
/// an open bottom downward by the height of the container.
class Container
{
public:
  /// `surface` is one piece, as wall_surface() makes it of particles inside;
  /// its lowest point is moved to z = 0. It is open at a flat rim at its top,
  /// and another one at an open bottom, or closed there by a flat lid or floor,
  /// which is taken off. Throws std::invalid_argument with one clear line on
  /// holes, more rims or pieces, and a rim that is not the widest
  /// cross-section.
  explicit Container(FacetSurface surface,
                     ContainerBottom bottom = ContainerBottom::closed);

  double rim() const { return height; } ///< above the lowest point [m]
  /// Area of the cross-section at a height; above the rim that of the rim
  /// [m^2].
  double section(double z) const;
  /// Volume up to a height, exact for the triangles [m^3].
  double volume_below(double z) const;
  /// Height at which that is the volume [m].
  double height_of(double volume) const;
  const Vec3 &lower() const { return least; } ///< corner of its box [m]
  const Vec3 &upper() const { return most; }  ///< corner at the rim [m]
  /// Lower rim, seen from above; empty with a closed bottom.
  const Polygon &foot() const { return lower_rim; }
  /// Whether a sphere is inside of container and collar.
  bool holds(const Vec3 &centre, double radius) const;
  /// Whether an upright column of this convex cross-section is inside from the
  /// lowest point to the end of the collar. It may touch the walls.
  bool holds_column(const Polygon &section) const;

  /// Height of the collar above the rim; that of the container at first [m].
  void set_collar(double its_height);
  /// Container with all that continues it; facets show away from the particles.
  const FacetSurface &wall() const { return with_collar; }

private:
  /// What a triangle adds to cross-section and volume.
  struct Slope
  {
    double low = 0., middle = 0., high = 0.; ///< heights of its corners [m]
    /// Area of its projection along z, positive where it shows down [m^2].
    double area = 0.;

    double share_below(double z) const; ///< of the area [-]
    double depth_below(double z) const; ///< integral of that over z [m]
  };

  using Edge = std::array<std::int32_t, 2>;
  /// Open edges, each in the direction of its triangle.
  struct Rims
  {
    std::vector<Edge> top, bottom;
  };
  enum class End
  {
    top,
    bottom
  };

  bool is_at(End end, const Vec3 &point) const;
  void open_end(End end, FacetSurface &surface) const;
  Rims rims_of(const FacetSurface &surface) const;
  void add_slopes(const FacetSurface &surface);
  void require_wide_mouth() const;
  void continue_wall(const std::vector<Edge> &rim, double by,
                     FacetSurface &closed);

  ContainerBottom bottom;
  double height = 0.;
  double near_end = 0.; ///< of points at an end [m]
  Vec3 least, most;
  Polygon lower_rim;
  std::vector<Slope> slopes;
  FacetSurface shell; ///< without collar
  FacetSurface with_collar;
  WallClearance inside; ///< of the same with a cover
};
} // namespace dem
