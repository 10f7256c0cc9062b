#pragma once

#include <dem/boundary/wall_clearance.h>

#include <array>
#include <cstdint>
#include <map>
#include <vector>

namespace dem
{
/// The inside of a container of any shape: rigid walls round the particles,
/// open at the top. Above its rim the walls continue upward as a collar.
class Container
{
public:
  /// `surface` is one piece, as wall_surface() makes it of particles inside;
  /// its lowest point is moved to z = 0. It is open at a flat rim at its top,
  /// or closed there by a flat lid, which is taken off. Throws
  /// std::invalid_argument with one clear line on holes, more than one rim or
  /// piece, and a rim that is not the widest cross-section.
  explicit Container(FacetSurface surface);

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
  /// Whether a sphere is inside of container and collar.
  bool holds(const Vec3 &centre, double radius) const;

  /// Height of the collar above the rim; that of the container at first [m].
  void set_collar(double its_height);
  /// Container with collar; facets show away from the particles.
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

  void take_lid_off(FacetSurface &surface) const;
  std::vector<std::array<std::int32_t, 2>>
  rim_of(const FacetSurface &surface) const;
  void add_slopes(const FacetSurface &surface);
  void require_wide_mouth() const;
  void add_cover(const std::vector<std::array<std::int32_t, 2>> &rim,
                 const std::map<std::int32_t, std::int32_t> &upper);

  double height = 0.;
  Vec3 least, most;
  std::vector<Slope> slopes;
  FacetSurface shell; ///< without collar
  FacetSurface with_collar;
  WallClearance inside; ///< of the same with a cover
};
} // namespace dem
