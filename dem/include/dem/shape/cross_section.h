#pragma once

#include <dem/shape/particle_shape.h>
#include <dem/shape/polygon.h>

#include <memory>
#include <span>
#include <vector>

namespace dem
{
/// A plane z = height of a frame whose origin is that of a series.
struct SectionPlane
{
  Mat3 rotation = Mat3::Identity(); ///< of the body: body frame to this frame
  double height = 0.;               ///< above the origin of the series [m]
};

/// One closed curve of a section.
struct SectionLoop
{
  Polygon corners;
  /// What the curve encloses, the bulge of the surface between the corners
  /// included; negative round a hole [m^2].
  double area = 0.;
};

/// [m^2].
double section_area(std::span<const SectionLoop> section);

/// A body x = r(s) s that planes are put through.
class SectionedBody
{
public:
  /// `series` must live as long; its values times `scale` are r [m].
  explicit SectionedBody(std::span<const double> series, double scale = 1.);

  /// The same series at another scale, which costs nothing.
  SectionedBody at_scale(double other) const;

  /// Curves in x and y of the frame of the plane, from the origin of the series
  /// [m]. They bound where the body is cut: none if it is not, several where
  /// the body is cut in more than one part. Every corner lies on the surface of
  /// the series to round-off. Parts that are narrower than 3.75 degrees seen
  /// from the origin may be missing.
  ///
  /// The corners are the zeros of r(s) (s . n) - height along the sides of
  /// triangles between 48 x 96 nodes of the unit sphere and its poles. Between
  /// them the area is that of the cubic with the tangents of the surface.
  std::vector<SectionLoop> section(const SectionPlane &plane) const;

  /// r in the direction of a point of this frame [m].
  double radius_towards(const SectionPlane &plane,
                        const Eigen::Vector2d &point) const;

private:
  std::span<const double> series;
  double scale;
  std::shared_ptr<const std::vector<double>> node_radius; ///< series alone
};

/// What a particle has lost in a plane.
struct LostRegions
{
  std::vector<Polygon> regions; ///< inside before, outside after
  double depth = 0.;       ///< largest loss of radius at the outline before [m]
  double area_before = 0.; ///< of the section before [m^2]
};

/// The regions between the section of a body before and after it has lost
/// material, where its radius has dropped by more than `least_depth` [m].
/// Outer corners lie on the surface before, inner ones on the surface after:
/// the first point along the inward normal of the outline. Where nothing of a
/// part is left, they are its centroid.
LostRegions lost_regions(const SectionedBody &before,
                         const SectionedBody &after, const SectionPlane &plane,
                         double least_depth);
} // namespace dem
